#include "host/picture_file.h"

#include "host/errors.h"
#include "host/picture_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <climits>

namespace clucida::host {
namespace {

struct Ending {
    std::string_view ending;
    FileFormat format;
};
constexpr Ending endings[] = {{"png", FileFormat::png}, {"jpg", FileFormat::jpeg}, {"jpeg", FileFormat::jpeg},
                              {"hdr", FileFormat::hdr}, {"pfm", FileFormat::pfm},  {"ppm", FileFormat::ppm},
                              {"pnm", FileFormat::ppm}};

} // namespace

std::string lower_ending(std::string_view name)
{
    const auto dot = name.rfind('.');
    std::string ending(dot == std::string_view::npos ? name : name.substr(dot + 1));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return ending;
}

std::optional<FileFormat> file_format(std::string_view name)
{
    const std::string ending = lower_ending(name);
    for (const Ending& e : endings)
        if (e.ending == ending) return e.format;
    return std::nullopt;
}

std::string file_endings()
{
    std::string out;
    for (const Ending& e : endings) out += fmt::format("{}{}", out.empty() ? "" : ", ", e.ending);
    return out;
}

void require_encodable(unsigned width, unsigned height, FileFormat format, const EncodeOptions& options)
{
    if (options.depth != 8 && options.depth != 16)
        throw UsageError(fmt::format("a depth of {} bits is not supported; there are 8 and 16", options.depth));
    if (options.depth == 16 && format != FileFormat::png && format != FileFormat::ppm)
        throw UsageError("a depth of 16 bits is for png and ppm; hdr and pfm hold floats anyway");
    if (options.quality < 1 || options.quality > 100) throw UsageError("JPEG's quality lies within 1 and 100");
    if (format == FileFormat::jpeg && (width > 65500 || height > 65500))
        throw UsageError("a JPEG is at most 65500 pixels wide and high; use png");
    // The encoder counts samples in an int.
    if (format == FileFormat::jpeg && std::uint64_t{3} * width * height > INT_MAX)
        throw UsageError("a JPEG has at most 715 million pixels here; use png");
}

std::string encode(const Picture& picture, FileFormat format, const EncodeOptions& options)
{
    std::string out;
    PictureWriter writer(picture.width, picture.height, format, options,
                         [&](std::uint64_t offset, std::string_view bytes) {
                             out.resize(std::max<std::size_t>(out.size(), offset + bytes.size()));
                             std::copy(bytes.begin(), bytes.end(), out.begin() + static_cast<std::ptrdiff_t>(offset));
                         });
    writer.add(picture.rgb);
    writer.finish();
    return out;
}

} // namespace clucida::host
