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

double equal_share(const host::Picture& a, const host::Picture& b)
{
    const double pixels = static_cast<double>(a.width) * a.height;
    return pixels > 0 ? static_cast<double>(host::compare_bytes(a, b).equal) / pixels : 1;
}

Cost cost_of(const host::Picture& a, const host::Picture& b)
{
    const host::Comparison c = host::compare(a, b, 0);
    return {c.rmse, c.max_error, c.psnr, equal_share(a, b)};
}

OracleCosts oracle_costs(const scene::Scene& scene, const scene::View& view, std::span<const oracle::Pixel> pixels,
                         unsigned threads)
{
    const std::vector<oracle::Pixel> some = some_of(pixels);
    const auto paths = [&](const oracle::Options& options) {
        return make_truth(scene, options, RealType::float64, threads)(some);
    };
    const std::vector<oracle::Path> as_is = paths({view, true, {}});
    return {cost_of_paths(paths({view, true, oracle::Disturbance{1, 0x1p-24}}), as_is, Which::same_paths),
            cost_of_paths(as_is, paths({view, false, {}}), Which::all)};
}

} // namespace clucida::bench
