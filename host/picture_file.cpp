#include "host/picture_file.h"

#include "host/errors.h"

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include <bit>
#include <cctype>
#include <cstring>

namespace clucida::host {
namespace {

struct Ending {
    std::string_view ending;
    FileFormat format;
};
constexpr Ending endings[] = {{"png", FileFormat::png}, {"jpg", FileFormat::jpeg}, {"jpeg", FileFormat::jpeg},
                              {"hdr", FileFormat::hdr}, {"pfm", FileFormat::pfm},  {"ppm", FileFormat::ppm},
                              {"pnm", FileFormat::ppm}};

void append(void* context, void* data, int size)
{
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

std::string samples_8(const Picture& picture, Transfer transfer)
{
    const auto bytes = develop_8(picture, transfer);
    return {bytes.begin(), bytes.end()};
}

/// Most significant byte first.
std::string samples_16(const Picture& picture, Transfer transfer)
{
    std::string out;
    out.reserve(picture.rgb.size() * 2);
    for (const std::uint16_t v : develop_16(picture, transfer)) {
        out += static_cast<char>(v >> 8);
        out += static_cast<char>(v & 255);
    }
    return out;
}

std::string samples(const Picture& picture, const EncodeOptions& options)
{
    return options.depth == 16 ? samples_16(picture, options.transfer) : samples_8(picture, options.transfer);
}

std::string encode_jpeg(const Picture& picture, const EncodeOptions& options)
{
    const std::string bytes = samples_8(picture, options.transfer);
    std::string out;
    if (!stbi_write_jpg_to_func(append, &out, static_cast<int>(picture.width), static_cast<int>(picture.height), 3,
                                bytes.data(), static_cast<int>(options.quality)))
        throw Failure("the JPEG encoder failed");
    return out;
}

std::string encode_hdr(const Picture& picture)
{
    std::string out;
    if (!stbi_write_hdr_to_func(append, &out, static_cast<int>(picture.width), static_cast<int>(picture.height), 3,
                                picture.rgb.data()))
        throw Failure("the Radiance encoder failed");
    return out;
}

/// Portable float map: rows from the bottom; a negative scale says least significant byte first.
std::string encode_pfm(const Picture& picture)
{
    static_assert(std::endian::native == std::endian::little);
    std::string out = fmt::format("PF\n{} {}\n-1.0\n", picture.width, picture.height);
    const std::size_t row = std::size_t{3} * picture.width;
    for (std::size_t y = picture.height; y-- > 0;)
        out.append(reinterpret_cast<const char*>(picture.rgb.data() + y * row), row * sizeof(float));
    return out;
}

std::string encode_ppm(const Picture& picture, const EncodeOptions& options)
{
    return fmt::format("P6\n{} {}\n{}\n", picture.width, picture.height, options.depth == 16 ? 65535 : 255) +
           samples(picture, options);
}

} // namespace

std::optional<FileFormat> file_format(std::string_view name)
{
    const auto dot = name.rfind('.');
    std::string ending(dot == std::string_view::npos ? name : name.substr(dot + 1));
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
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
}

std::string encode(const Picture& picture, FileFormat format, const EncodeOptions& options)
{
    require_encodable(picture.width, picture.height, format, options);
    switch (format) {
    case FileFormat::png:
        return encode_png(picture.width, picture.height, options.depth, samples(picture, options), options);
    case FileFormat::jpeg: return encode_jpeg(picture, options);
    case FileFormat::hdr: return encode_hdr(picture);
    case FileFormat::pfm: return encode_pfm(picture);
    case FileFormat::ppm: return encode_ppm(picture, options);
    }
    throw Failure("no such format");
}

} // namespace clucida::host
