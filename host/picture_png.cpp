#include "host/picture_png.h"

#include "host/errors.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <utility>

namespace clucida::host {
namespace {

constexpr int compression_level = 5;
constexpr std::size_t idat_bytes = std::size_t{1} << 20; ///< of one IDAT chunk

void add_u32(std::string& out, std::uint32_t v)
{
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(v >> shift & 255);
}

void add_chunk(std::string& out, std::string_view type, std::string_view data)
{
    add_u32(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    out += type;
    out += data;
    const auto* bytes = reinterpret_cast<const Bytef*>(out.data() + begin);
    add_u32(out, static_cast<std::uint32_t>(crc32(0, bytes, static_cast<uInt>(out.size() - begin))));
}

/// tEXt holds Latin-1 only; anything beyond ASCII goes to iTXt, which is UTF-8.
void add_text(std::string& out, const std::string& keyword, const std::string& text)
{
    using namespace std::string_literals;
    const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return c == '\n' || (c >= 32 && c < 127); });
    if (ascii)
        add_chunk(out, "tEXt", keyword + "\0"s + text);
    else
        add_chunk(out, "iTXt", keyword + "\0\0\0\0\0"s + text);
}

std::uint8_t paeth(int left, int up, int corner)
{
    const int p = left + up - corner;
    const int a = std::abs(p - left), b = std::abs(p - up), c = std::abs(p - corner);
    return static_cast<std::uint8_t>(a <= b && a <= c ? left : b <= c ? up : corner);
}

/// A row filtered by Paeth's predictor, which does well on rendered pictures; step is the bytes of a pixel.
void filter_row(const std::uint8_t* row, const std::uint8_t* above, std::size_t bytes, std::size_t step, Bytef* out)
{
    *out++ = 4;
    for (std::size_t i = 0; i < bytes; ++i) {
        const int left = i < step ? 0 : row[i - step];
        const int up = above ? above[i] : 0;
        const int corner = above && i >= step ? above[i - step] : 0;
        out[i] = static_cast<Bytef>(row[i] - paeth(left, up, corner));
    }
}

/// zlib's stream, cut into IDAT chunks.
class Deflate {
public:
    explicit Deflate(std::string& out) : out_(out), buffer_(idat_bytes, '\0')
    {
        if (deflateInit(&stream_, compression_level) != Z_OK) throw Failure("the PNG encoder failed");
        rewind();
    }
    ~Deflate() { deflateEnd(&stream_); }
    Deflate(const Deflate&) = delete;
    Deflate& operator=(const Deflate&) = delete;

    void add(std::vector<Bytef>& bytes) { run(bytes.data(), bytes.size(), Z_NO_FLUSH); }
    void finish()
    {
        run(nullptr, 0, Z_FINISH);
        flush();
    }

private:
    void run(Bytef* bytes, std::size_t count, int mode)
    {
        stream_.next_in = bytes;
        stream_.avail_in = static_cast<uInt>(count);
        int state = Z_OK;
        do {
            if (stream_.avail_out == 0) flush();
            state = deflate(&stream_, mode);
            if (state == Z_STREAM_ERROR) throw Failure("the PNG encoder failed");
        } while (mode == Z_FINISH ? state != Z_STREAM_END : stream_.avail_in > 0);
    }
    void flush()
    {
        const std::size_t used = buffer_.size() - stream_.avail_out;
        if (used) add_chunk(out_, "IDAT", std::string_view(buffer_).substr(0, used));
        rewind();
    }
    void rewind()
    {
        stream_.next_out = reinterpret_cast<Bytef*>(buffer_.data());
        stream_.avail_out = static_cast<uInt>(buffer_.size());
    }

    std::string& out_;
    std::string buffer_;
    z_stream stream_{};
};

} // namespace

struct PngEncoder::State {
    std::size_t step, row; ///< bytes of a pixel and of a row
    std::string out;
    std::string above; ///< the row before, empty at the top
    std::vector<Bytef> filtered;
    Deflate deflate{out};

    State(std::size_t step, std::size_t row) : step(step), row(row), filtered(row + 1) {}

    void add(std::string_view samples)
    {
        const auto* bytes = reinterpret_cast<const std::uint8_t*>(samples.data());
        const auto* before = above.empty() ? nullptr : reinterpret_cast<const std::uint8_t*>(above.data());
        for (std::size_t at = 0; at < samples.size(); at += row) {
            filter_row(bytes + at, before, row, step, filtered.data());
            deflate.add(filtered);
            before = bytes + at;
        }
        if (!samples.empty()) above = samples.substr(samples.size() - row);
    }
};

PngEncoder::PngEncoder(unsigned width, unsigned height, const EncodeOptions& options)
{
    const std::size_t step = std::size_t{3} * options.depth / 8;
    state_ = std::make_unique<State>(step, step * width);
    std::string& out = state_->out;
    out = "\x89PNG\r\n\x1a\n";
    std::string header;
    add_u32(header, width);
    add_u32(header, height);
    header += static_cast<char>(options.depth);
    header += std::string("\2\0\0\0", 4); // RGB, deflate, the usual filters, not interlaced
    add_chunk(out, "IHDR", header);
    if (options.transfer == Transfer::srgb) add_chunk(out, "sRGB", std::string(1, '\0'));
    for (const auto& [keyword, text] : options.metadata) add_text(out, keyword, text);
}

PngEncoder::~PngEncoder() = default;

void PngEncoder::add(std::string_view samples)
{
    state_->add(samples);
}

std::string PngEncoder::take()
{
    return std::exchange(state_->out, {});
}

std::string PngEncoder::finish()
{
    state_->deflate.finish();
    add_chunk(state_->out, "IEND", {});
    return take();
}

} // namespace clucida::host
