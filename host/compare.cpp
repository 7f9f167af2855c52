#include "host/compare.h"

#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace clucida::host {
namespace {

/// The difference of two channels; infinities of one sign are equal.
double difference(float a, float b)
{
    return a == b ? 0 : std::fabs(double{a} - double{b});
}

} // namespace

double percentile(std::vector<double>& values, double share)
{
    if (values.empty()) return 0;
    const double rank = std::ceil(share * static_cast<double>(values.size()));
    const auto place = values.begin() + std::max<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(rank) - 1, 0);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

void require_same_size(const Picture& a, const Picture& b)
{
    if (a.width != b.width || a.height != b.height)
        throw Failure(
            fmt::format("the pictures differ in size: {}x{} and {}x{}", a.width, a.height, b.width, b.height));
}

Comparison compare(const Picture& a, const Picture& b, double threshold)
{
    require_same_size(a, b);
    Comparison out;
    out.pixels = std::uint64_t{a.width} * a.height;
    double squares = 0, sum = 0;
    std::vector<double> differences;
    differences.reserve(a.rgb.size());
    for (std::size_t pixel = 0; pixel < out.pixels; ++pixel) {
        bool over = false;
        for (unsigned channel = 0; channel < 3; ++channel) {
            const std::size_t i = 3 * pixel + channel;
            const double d = difference(a.rgb[i], b.rgb[i]);
            if (std::isnan(d)) {
                ++out.not_numbers;
                continue;
            }
            squares += d * d;
            sum += d;
            differences.push_back(d);
            over = over || d > threshold;
            if (d > out.max_error) {
                out.max_error = d;
                out.max_x = static_cast<unsigned>(pixel % a.width);
                out.max_y = static_cast<unsigned>(pixel / a.width);
                out.max_channel = channel;
            }
        }
        out.over += over;
    }
    const auto counted = static_cast<double>(3 * out.pixels - out.not_numbers);
    if (counted > 0) {
        out.rmse = std::sqrt(squares / counted);
        out.mean_error = sum / counted;
    }
    out.p50 = percentile(differences, 0.5);
    out.p99 = percentile(differences, 0.99);
    out.p999 = percentile(differences, 0.999);
    out.psnr = -20 * std::log10(out.rmse);
    return out;
}

ByteComparison compare_bytes(const Picture& a, const Picture& b, Transfer transfer)
{
    require_same_size(a, b);
    const auto x = develop_8(a, transfer), y = develop_8(b, transfer);
    ByteComparison out;
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < x.size(); i += 3) {
        unsigned most = 0;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const auto steps = static_cast<unsigned>(std::abs(x[i + channel] - y[i + channel]));
            sum += steps;
            most = std::max(most, steps);
        }
        out.equal += most == 0;
        out.max_steps = std::max(out.max_steps, most);
    }
    if (!x.empty()) out.mean_steps = static_cast<double>(sum) / static_cast<double>(x.size());
    return out;
}

Plane error_map(const Picture& a, const Picture& b)
{
    require_same_size(a, b);
    Plane out = make_plane(a.width, a.height);
    for (std::size_t i = 0; i < a.rgb.size(); ++i) {
        const double d = difference(a.rgb[i], b.rgb[i]);
        float& most = out.value[i / 3];
        if (!(d <= most) && !std::isnan(most)) most = static_cast<float>(d);
    }
    return out;
}

} // namespace clucida::host
