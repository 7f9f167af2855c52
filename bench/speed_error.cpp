#include "bench/speed_error.h"

#include "host/errors.h"
#include "host/interrupt.h"

#include <algorithm>
#include <array>

namespace clucida::bench {
namespace {

constexpr std::size_t chunk_pixels = 1024; ///< between looks at the user's wish to stop

/// Every so many pixels of a side, the first and the last half as far from its ends, or nearly.
std::vector<unsigned> places(unsigned side, unsigned step)
{
    std::vector<unsigned> out;
    for (unsigned at = std::min(step / 2, side - 1); at < side; at += step) out.push_back(at);
    return out;
}

} // namespace

std::vector<std::size_t> grid_pixels(host::Shape picture, std::size_t most)
{
    unsigned step = 1;
    while (places(picture.width, step).size() * places(picture.height, step).size() > std::max<std::size_t>(most, 1))
        ++step;
    std::vector<std::size_t> out;
    for (const unsigned y : places(picture.height, step))
        for (const unsigned x : places(picture.width, step)) out.push_back(std::size_t{y} * picture.width + x);
    return out;
}

host::Picture true_pixels(const host::SceneSource& source, const scene::View& view, std::span<const std::size_t> pixels,
                          unsigned threads)
{
    oracle::Options options{view, true, {}};
    options.view.as_original = source.as_original;
    const Truth truth = make_truth(source.scene, options, RealType::long_double, threads);
    host::Picture out = host::make_picture(static_cast<unsigned>(pixels.size()), 1);
    std::vector<oracle::Pixel> asked;
    std::vector<std::array<double, 3>> sums(pixels.size());
    std::size_t done = 0;
    const auto ask = [&] {
        if (host::interrupted()) throw host::Interrupted();
        for (const oracle::Path& path : truth(asked)) {
            for (std::size_t k = 0; k < 3; ++k) sums[done / view.samples][k] += path.rgb[k];
            ++done;
        }
        asked.clear();
    };
    for (const std::size_t i : pixels) {
        const auto x = static_cast<unsigned>(i % view.width), y = static_cast<unsigned>(i / view.width);
        for (unsigned sample = 0; sample < view.samples; ++sample) {
            asked.push_back({x, y, sample});
            if (asked.size() == chunk_pixels) ask();
        }
    }
    ask();
    for (std::size_t i = 0; i < sums.size(); ++i)
        for (std::size_t k = 0; k < 3; ++k) out.rgb[3 * i + k] = static_cast<float>(sums[i][k] / view.samples);
    return out;
}

} // namespace clucida::bench
