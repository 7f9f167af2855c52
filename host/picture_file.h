/// Pictures as files: their bytes, and back.
#pragma once

#include "host/picture.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clucida::host {

enum class FileFormat { png, jpeg, hdr, pfm, ppm };

/// By the ending of a file's name, or by the ending alone ("png"); whatever the case.
std::optional<FileFormat> file_format(std::string_view name);

/// The endings there are, for messages: "png, jpg, ...".
std::string file_endings();

/// Keyword and text, UTF-8; kept by PNG. Of the other formats all but pfm keep the fingerprint, as a comment.
using Metadata = std::vector<std::pair<std::string, std::string>>;

/// The keyword of the digest of what a picture is made of (host/fingerprint.h).
inline constexpr const char* fingerprint_keyword = "Fingerprint";

struct EncodeOptions {
    Transfer transfer = Transfer::srgb; ///< of png, jpeg and ppm; hdr and pfm are always linear
    unsigned depth = 8;                 ///< bits of a channel, 8 or 16; 16 for png and ppm
    unsigned quality = 90;              ///< of jpeg, 1..100
    Metadata metadata = {};
};

/// @throws UsageError if the format cannot hold such a picture
void require_encodable(unsigned width, unsigned height, FileFormat format, const EncodeOptions& options);

/// The bytes of the file. The same picture and options give the same bytes.
/// @throws UsageError as require_encodable, Failure if the encoder fails
std::string encode(const Picture& picture, FileFormat format, const EncodeOptions& options = {});

/// A picture of any of the formats (and of the others that stb_image reads), by its content. Integer samples are
/// taken through the inverse of `transfer`.
/// @throws Failure if it is none of these
Picture decode(std::string_view bytes, const std::string& name, Transfer transfer = Transfer::srgb);

/// @throws Failure if it cannot be read or understood
Picture read_picture(const std::filesystem::path& file, Transfer transfer = Transfer::srgb);

} // namespace clucida::host
