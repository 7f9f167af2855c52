/// Binary PGM and PPM, of 8 or 16 bits. stb_image reads them too, but takes the bytes of 16-bit samples in the wrong
/// order, reads outside its buffer for a grey picture of them, and takes no note of the largest value.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace clucida::scene {

struct Pnm {
    unsigned width = 0, height = 0;
    unsigned most = 255;                ///< the value that means 1
    std::vector<std::uint16_t> samples; ///< 0..most, three a pixel, rows from the top
    std::string fault;                  ///< what is wrong, and then no samples; empty if nothing is
};

bool is_pnm(std::string_view bytes);
Pnm read_pnm(std::string_view bytes);

} // namespace clucida::scene
