#include "host/picture_writer.h"

#include "host/errors.h"
#include "host/picture_png.h"

#include <fmt/format.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <bit>
#include <optional>
#include <utility>

namespace clucida::host {
namespace {

constexpr std::size_t slice_pixels = std::size_t{1} << 17; ///< developed at a time

void append(void* context, void* data, int size)
{
    static_cast<std::string*>(context)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

/// Most significant byte first.
std::string samples(std::span<const float> rgb, unsigned depth, Transfer transfer)
{
    if (depth == 8) {
        const auto bytes = develop_8(rgb, transfer);
        return {bytes.begin(), bytes.end()};
    }
    std::string out;
    out.reserve(rgb.size() * 2);
    for (const std::uint16_t v : develop_16(rgb, transfer)) {
        out += static_cast<char>(v >> 8);
        out += static_cast<char>(v & 255);
    }
    return out;
}

std::string encode_jpeg(unsigned width, unsigned height, const std::string& samples, unsigned quality)
{
    std::string out;
    if (!stbi_write_jpg_to_func(append, &out, static_cast<int>(width), static_cast<int>(height), 3, samples.data(),
                                static_cast<int>(quality)))
        throw Failure("the JPEG encoder failed");
    return out;
}

/// A text of the metadata as a line of a comment, with what begins and ends it; or nothing.
std::string comment(const Metadata& metadata, std::string_view keyword, std::string_view begin, std::string_view end)
{
    for (const auto& [key, text] : metadata)
        if (key == keyword) return fmt::format("{}{}: {}{}", begin, key, text, end);
    return {};
}

/// A JPEG with a comment behind its first marker.
std::string with_comment(const std::string& jpeg, const std::string& text)
{
    if (text.empty()) return jpeg;
    const std::size_t length = text.size() + 2;
    const std::string marker = {'\xFF', '\xFE', static_cast<char>(length >> 8), static_cast<char>(length & 255)};
    return jpeg.substr(0, 2) + marker + text + jpeg.substr(2);
}

/// Rows of a Radiance picture, each coded by itself: what stb_image_write makes of a picture of these rows alone, its
/// header of two paragraphs told apart.
struct HdrRows {
    std::string header, rows;
};

HdrRows encode_hdr(unsigned width, std::span<const float> rgb)
{
    const std::size_t count = rgb.size() / 3 / width;
    HdrRows out;
    if (!stbi_write_hdr_to_func(append, &out.rows, static_cast<int>(width), static_cast<int>(count), 3, rgb.data()))
        throw Failure("the Radiance encoder failed");
    const std::size_t size = out.rows.find("\n\n") + 2;
    out.header = out.rows.substr(0, size);
    out.rows.erase(0, out.rows.find('\n', size) + 1);
    return out;
}

} // namespace

struct PictureWriter::State {
    unsigned width, height;
    FileFormat format;
    EncodeOptions options;
    PutBytes put;
    std::uint64_t offset = 0; ///< where the file goes on
    std::size_t rows = 0;     ///< that were added
    std::optional<PngEncoder> png;
    std::string jpeg; ///< samples of the rows that were added

    State(unsigned width, unsigned height, FileFormat format, EncodeOptions options, PutBytes put)
        : width(width), height(height), format(format), options(std::move(options)), put(std::move(put))
    {
    }

    void append(std::string_view bytes)
    {
        put(offset, bytes);
        offset += bytes.size();
    }

    /// What formats besides PNG keep of the metadata.
    std::string kept_comment(std::string_view begin_, std::string_view end) const
    {
        return comment(options.metadata, fingerprint_keyword, begin_, end);
    }

    void begin()
    {
        switch (format) {
        case FileFormat::png: png.emplace(width, height, options); break;
        case FileFormat::ppm:
            append(fmt::format("P6\n{}{} {}\n{}\n", kept_comment("# ", "\n"), width, height,
                               options.depth == 16 ? 65535 : 255));
            break;
        // A portable float map; a negative scale says least significant byte first.
        case FileFormat::pfm: append(fmt::format("PF\n{} {}\n-1.0\n", width, height)); break;
        case FileFormat::jpeg: jpeg.reserve(std::size_t{3} * width * height); break;
        case FileFormat::hdr: break; // the encoder has a header of its own
        }
    }

    void add(std::span<const float> rgb)
    {
        const std::size_t count = rgb.size() / 3 / width;
        switch (format) {
        case FileFormat::png:
            png->add(samples(rgb, options.depth, options.transfer));
            append(png->take());
            break;
        case FileFormat::ppm: append(samples(rgb, options.depth, options.transfer)); break;
        case FileFormat::pfm: add_from_below(rgb, count); break;
        case FileFormat::jpeg: jpeg += samples(rgb, 8, options.transfer); break;
        case FileFormat::hdr: {
            const HdrRows hdr = encode_hdr(width, rgb);
            if (rows == 0) {
                const std::size_t line = hdr.header.find('\n') + 1;
                append(hdr.header.substr(0, line) + kept_comment("# ", "\n") + hdr.header.substr(line) +
                       fmt::format("-Y {} +X {}\n", height, width));
            }
            append(hdr.rows);
            break;
        }
        }
        rows += count;
    }

    /// The rows of a float map go from the bottom to the top.
    void add_from_below(std::span<const float> rgb, std::size_t count)
    {
        static_assert(std::endian::native == std::endian::little);
        const std::size_t row = std::size_t{3} * width;
        std::string bytes;
        bytes.reserve(rgb.size_bytes());
        for (std::size_t y = count; y-- > 0;)
            bytes.append(reinterpret_cast<const char*>(rgb.data() + y * row), row * sizeof(float));
        put(offset + (height - rows - count) * row * sizeof(float), bytes);
    }

    void finish()
    {
        if (format == FileFormat::png) append(png->finish());
        if (format == FileFormat::jpeg)
            append(with_comment(encode_jpeg(width, height, jpeg, options.quality), kept_comment("", "")));
    }
};

PictureWriter::PictureWriter(unsigned width, unsigned height, FileFormat format, const EncodeOptions& options,
                             PutBytes put)
{
    require_encodable(width, height, format, options);
    state_ = std::make_unique<State>(width, height, format, options, std::move(put));
    state_->begin();
}

PictureWriter::~PictureWriter() = default;

void PictureWriter::add(std::span<const float> rgb)
{
    if (rgb.empty()) return; // as all rows of a picture without columns are
    const std::size_t row = std::size_t{3} * state_->width;
    const std::size_t slice = std::max<std::size_t>(slice_pixels / state_->width, 1) * row;
    for (; !rgb.empty(); rgb = rgb.subspan(std::min(slice, rgb.size())))
        state_->add(rgb.first(std::min(slice, rgb.size())));
}

void PictureWriter::finish()
{
    state_->finish();
}

} // namespace clucida::host
