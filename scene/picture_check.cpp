#include "scene/picture_check.h"

#include <charconv>
#include <cstddef>

namespace clucida::scene {
namespace {

/// Bytes from the front; past the end they are 0, and `ended` says so.
struct Bytes {
    std::string_view text;
    std::size_t at = 0;
    bool ended() const { return at >= text.size(); }
    std::size_t left() const { return text.size() - at; }
    unsigned next() { return ended() ? 0U : static_cast<unsigned char>(text[at++]); }
    unsigned next_two()
    {
        const unsigned high = next();
        return high << 8U | next();
    }
    void skip(std::size_t count) { at = count < text.size() - at ? at + count : text.size(); }
};

/// Huffman tables of a JPEG: 16 counts of codes, together no more than there are values of a byte, or 2.27 writes past
/// its table.
bool sound_huffman_tables(Bytes segment)
{
    while (!segment.ended()) {
        segment.next();
        unsigned codes = 0;
        for (int length = 1; length <= 16; ++length) codes += segment.next();
        if (codes > 256) return false;
        segment.skip(codes);
    }
    return true;
}

std::string jpeg_fault(std::string_view text)
{
    constexpr unsigned huffman_tables = 0xC4, start_of_scan = 0xDA, first_alone = 0xD0, last_alone = 0xD9;
    Bytes bytes{text};
    while (!bytes.ended()) {
        if (bytes.next() != 0xFF) continue; // coded data, or blanks between segments
        unsigned marker = bytes.next();
        while (marker == 0xFF && !bytes.ended()) marker = bytes.next();
        if (marker == 0 || marker == 1 || (marker >= first_alone && marker <= last_alone)) continue;
        const std::size_t length = bytes.next_two();
        if (length < 2) return "a segment of the JPEG is too short";
        const std::string_view segment = text.substr(bytes.at, length - 2);
        if (marker == huffman_tables && !sound_huffman_tables({segment})) return "a table of the JPEG is too long";
        if (marker != start_of_scan) bytes.skip(length - 2);
    }
    return {};
}

/// Chunks of a PNG: 2.27 takes memory for what a chunk claims, up to 2 GiB, before it looks whether there is so much.
std::string png_fault(std::string_view text)
{
    constexpr std::size_t signature = 8, checksum = 4;
    Bytes bytes{text};
    bytes.skip(signature);
    while (!bytes.ended()) {
        const std::size_t high = bytes.next_two(), length = high << 16U | bytes.next_two();
        const std::string_view kind = text.substr(bytes.at, 4);
        if (kind == "IEND") return {};
        bytes.skip(kind.size());
        if (length > text.size() - bytes.at) return "the PNG is cut short";
        bytes.skip(length + checksum);
    }
    return "the PNG is cut short";
}

/// Takes word and the number after it from the front of text. False if they do not stand there.
bool take(std::string_view& text, std::string_view word, unsigned& number)
{
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    while (text.starts_with(' ')) text.remove_prefix(1);
    return error == std::errc{};
}

/// Behind the line that is empty, which ends the header of a Radiance picture, or npos.
std::size_t end_of_header(std::string_view text)
{
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string_view::npos) break;
        if (end == begin || text[begin] == '\0') return end + 1; // stb_image's idea of an empty line
        begin = end + 1;
    }
    return std::string_view::npos;
}

/// Runs of a Radiance picture: where the bytes end within them, 2.27 waits for ever.
std::string radiance_fault(std::string_view text)
{
    const std::size_t header = end_of_header(text);
    if (header == std::string_view::npos) return "the header of the Radiance picture has no end";
    std::string_view rest = text.substr(header);
    unsigned width = 0, height = 0;
    if (!take(rest, "-Y ", height) || !take(rest, "+X ", width)) return "the Radiance picture has no size '-Y N +X N'";
    if (width < 8 || width >= 32768) return {}; // never in runs
    const std::size_t line = rest.find('\n');
    if (line == std::string_view::npos) return "the Radiance picture is cut short";
    Bytes bytes{rest, line + 1};
    for (unsigned row = 0; row < height; ++row) {
        if (bytes.ended()) return "the Radiance picture is cut short";
        const unsigned first = bytes.next(), second = bytes.next(), high = bytes.next();
        if (first != 2 || second != 2 || (high & 0x80U) != 0) return {}; // no runs from here on
        if ((high << 8U | bytes.next()) != width) return {};
        for (unsigned channel = 0; channel < 4; ++channel) {
            for (unsigned left = width; left > 0;) {
                if (bytes.ended()) return "the Radiance picture is cut short";
                const unsigned count = bytes.next();
                const unsigned run = count > 128 ? count - 128 : count;
                if (run == 0 || run > left) return "a run of the Radiance picture is wrong";
                const std::size_t values = count > 128 ? 1 : run;
                if (bytes.left() < values) return "the Radiance picture is cut short";
                bytes.skip(values);
                left -= run;
            }
        }
    }
    return {};
}

} // namespace

std::string picture_fault(std::string_view bytes)
{
    if (bytes.starts_with('\xFF')) return jpeg_fault(bytes);
    if (bytes.starts_with("\x89PNG")) return png_fault(bytes);
    if (bytes.starts_with("#?RADIANCE\n") || bytes.starts_with("#?RGBE\n")) return radiance_fault(bytes);
    return {};
}

} // namespace clucida::scene
