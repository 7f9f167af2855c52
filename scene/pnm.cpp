#include "scene/pnm.h"

#include <algorithm>
#include <cstddef>

namespace clucida::scene {
namespace {

constexpr unsigned most_side = 65536;

/// The next number of the header, past blanks and comments; 0 if there is none.
unsigned header_number(std::string_view bytes, std::size_t& at)
{
    const auto digit = [&] { return at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9'; };
    while (at < bytes.size() && !digit()) {
        if (bytes[at] == '#') at = std::min(bytes.find('\n', at), bytes.size());
        ++at;
    }
    unsigned n = 0;
    for (; digit() && n <= most_side; ++at) n = 10 * n + static_cast<unsigned>(bytes[at] - '0');
    return n;
}

} // namespace

bool is_pnm(std::string_view bytes)
{
    return bytes.starts_with("P5") || bytes.starts_with("P6");
}

Pnm read_pnm(std::string_view bytes)
{
    Pnm pnm;
    const std::size_t channels = bytes.starts_with("P5") ? 1 : 3;
    std::size_t at = 2;
    pnm.width = header_number(bytes, at);
    pnm.height = header_number(bytes, at);
    pnm.most = header_number(bytes, at);
    ++at; // one blank ends the header
    if (pnm.width < 1 || pnm.height < 1 || pnm.most < 1 || pnm.width > most_side || pnm.height > most_side ||
        pnm.most > 65535) {
        pnm.fault = channels == 1 ? "the header of the PGM is wrong" : "the header of the PPM is wrong";
        return pnm;
    }
    const std::size_t step = pnm.most > 255 ? 2 : 1, pixels = std::size_t{pnm.width} * pnm.height;
    if (bytes.size() < at || bytes.size() - at < step * channels * pixels) {
        pnm.fault = channels == 1 ? "the PGM is cut short" : "the PPM is cut short";
        return pnm;
    }
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(bytes[at + i])); };
    pnm.samples.reserve(3 * pixels);
    for (std::size_t i = 0; i < channels * pixels; ++i) {
        const unsigned sample = step == 1 ? byte(i) : byte(2 * i) << 8U | byte(2 * i + 1);
        pnm.samples.insert(pnm.samples.end(), 3 / channels, static_cast<std::uint16_t>(std::min(sample, pnm.most)));
    }
    return pnm;
}

} // namespace clucida::scene
