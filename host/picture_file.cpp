#include "host/picture_file.h"

#include "host/errors.h"
#include "host/file_ending.h"
#include "host/picture_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>

namespace clucida::host {
namespace {

constexpr FileEnding<FileFormat> endings[] = {
    {"png", FileFormat::png}, {"jpg", FileFormat::jpeg}, {"jpeg", FileFormat::jpeg}, {"hdr", FileFormat::hdr},
    {"pfm", FileFormat::pfm}, {"ppm", FileFormat::ppm},  {"pnm", FileFormat::ppm}};

} // namespace

std::optional<FileFormat> file_format(std::string_view name)
{
    return format_of<FileFormat>(name, endings);
}

std::string file_endings()
{
    return listed<FileFormat>(endings);
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
