#include "bench/costs.h"

#include "bench/truth.h"
#include "host/compare.h"

namespace clucida::bench {
namespace {

constexpr std::size_t most_pixels = 14400;

std::vector<oracle::Pixel> some_of(std::span<const oracle::Pixel> pixels)
{
    std::vector<oracle::Pixel> out;
    const std::size_t step = (pixels.size() + most_pixels - 1) / most_pixels;
    for (std::size_t i = 0; i < pixels.size(); i += step) out.push_back(pixels[i]);
    return out;
}

enum class Which { all, same_paths };

/// Of the paths' colours.
Cost cost_of_paths(const std::vector<oracle::Path>& a, const std::vector<oracle::Path>& b, Which which)
{
    host::Picture x, y;
    x.width = y.width = 1;
    for (std::size_t i = 0; i < a.size(); i++) {
        if (which == Which::same_paths && a[i].events != b[i].events) continue;
        x.rgb.insert(x.rgb.end(), a[i].rgb.begin(), a[i].rgb.end());
        y.rgb.insert(y.rgb.end(), b[i].rgb.begin(), b[i].rgb.end());
        x.height = ++y.height;
    }
    return x.height > 0 ? cost_of(x, y) : Cost{};
}

} // namespace

Cost cost_of(const host::Picture& a, const host::Picture& b)
{
    const host::Comparison c = host::compare(a, b, 0);
    const double equal = static_cast<double>(host::compare_bytes(a, b).equal);
    return {c.rmse, c.max_error, c.psnr, equal / (static_cast<double>(a.width) * a.height)};
}

Cost cost_of_colors(const scene::Scene& scene, const oracle::Options& options, std::span<const oracle::Pixel> pixels,
                    unsigned threads)
{
    const std::vector<oracle::Pixel> some = some_of(pixels);
    oracle::Options stored = options, exact = options;
    stored.stored_colors = true;
    exact.stored_colors = false;
    return cost_of_paths(make_truth(scene, stored, RealType::float64, threads)(some),
                         make_truth(scene, exact, RealType::float64, threads)(some), Which::all);
}

Cost cost_of_rounding(const scene::Scene& scene, const oracle::Options& options, std::span<const oracle::Pixel> pixels,
                      unsigned threads)
{
    const std::vector<oracle::Pixel> some = some_of(pixels);
    oracle::Options disturbed = options;
    disturbed.disturbance = {1, 0x1p-24};
    return cost_of_paths(make_truth(scene, disturbed, RealType::float64, threads)(some),
                         make_truth(scene, options, RealType::float64, threads)(some), Which::same_paths);
}

} // namespace clucida::bench
