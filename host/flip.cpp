// Names and constants are the paper's; those of the colours are as in its authors' program (flip-evaluator 1.7).
#include "host/flip.h"

#include "host/compare.h"
#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace clucida::host {
namespace {

constexpr float q_c = 0.7F;              ///< exponent of the colour difference
constexpr float p_c = 0.4F, p_t = 0.95F; ///< p_c of the largest colour difference is moved to p_t
constexpr float q_f = 0.5F;              ///< exponent of the feature difference
constexpr double detector_width = 0.082; ///< w, of the feature detectors, in degrees

/// Weights for the neighbours -radius..radius.
using Kernel = std::vector<float>;

/// Scales the positive weights to the sum 1, and the negative to -1.
Kernel normalised(const std::vector<double>& weights)
{
    double positive = 0, negative = 0;
    for (const double v : weights) (v > 0 ? positive : negative) += std::fabs(v);
    Kernel out;
    for (const double v : weights) out.push_back(v == 0 ? 0 : static_cast<float>(v / (v > 0 ? positive : negative)));
    return out;
}

/// weight(k) for k in -radius..radius.
template <typename Weight>
std::vector<double> sample(int radius, Weight weight)
{
    std::vector<double> out;
    for (int k = -radius; k <= radius; ++k) out.push_back(weight(double(k)));
    return out;
}

// Planes: both filters go on with the edge's value beyond the edge.

void add_scaled(float* out, const float* in, float factor, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) out[i] += factor * in[i];
}

Plane along_rows(const Plane& in, const Kernel& kernel)
{
    Plane out = make_plane(in.width, in.height);
    const std::size_t width = in.width, radius = kernel.size() / 2;
    std::vector<float> padded(width + 2 * radius);
    for (std::size_t y = 0; y < in.height; ++y) {
        const float* row = in.value.data() + y * width;
        std::fill_n(padded.begin(), radius, row[0]);
        std::copy_n(row, width, padded.data() + radius);
        std::fill_n(padded.data() + radius + width, radius, row[width - 1]);
        for (std::size_t k = 0; k < kernel.size(); ++k)
            add_scaled(out.value.data() + y * width, padded.data() + k, kernel[k], width);
    }
    return out;
}

Plane along_columns(const Plane& in, const Kernel& kernel)
{
    Plane out = make_plane(in.width, in.height);
    const std::size_t width = in.width, radius = kernel.size() / 2;
    for (std::size_t y = 0; y < in.height; ++y)
        for (std::size_t k = 0; k < kernel.size(); ++k) {
            const std::size_t from = std::clamp<std::size_t>(y + k, radius, radius + in.height - 1) - radius;
            add_scaled(out.value.data() + y * width, in.value.data() + from * width, kernel[k], width);
        }
    return out;
}

Plane along_both(const Plane& in, const Kernel& kernel)
{
    return along_columns(along_rows(in, kernel), kernel);
}

/// The root of the sum of squares; the result takes a's place.
Plane lengths(Plane a, const Plane& b)
{
    for (std::size_t i = 0; i < a.value.size(); ++i)
        a.value[i] = std::sqrt(a.value[i] * a.value[i] + b.value[i] * b.value[i]);
    return a;
}

// Colours.

using Triple = std::array<float, 3>;
using Matrix = std::array<Triple, 3>;

/// Linear sRGB to CIE XYZ, each divided by that of white (D65): white becomes 1, 1, 1.
constexpr Matrix to_xyz = {{{10135552.F / 23359437, 8788810.F / 23359437, 4435075.F / 23359437},
                            {2613072.F / 12288897, 8788810.F / 12288897, 887015.F / 12288897},
                            {1425312.F / 80288307, 8788810.F / 80288307, 70074185.F / 80288307}}};
/// Its inverse.
constexpr Matrix from_xyz = {{{3.080341988F, -1.537398969F, -0.542943019F},
                              {-0.921178396F, 1.875929984F, 0.045248412F},
                              {0.052881293F, -0.204011206F, 1.151129913F}}};

Triple times(const Matrix& m, const Triple& v)
{
    Triple out;
    for (std::size_t i = 0; i < 3; ++i) out[i] = m[i][0] * v[0] + m[i][1] * v[1] + m[i][2] * v[2];
    return out;
}

float within_0_and_1(float v)
{
    return v > 0 ? std::min(v, 1.0F) : 0; // NaN: 0
}

/// CIE L*a*b* of linear light, a* and b* weakened in the dark (Hunt's effect).
Triple hunt_lab(const Triple& rgb)
{
    constexpr float delta = 6.0F / 29;
    Triple f = times(to_xyz, rgb);
    for (float& v : f) v = v > delta * delta * delta ? std::cbrt(v) : v / (3 * delta * delta) + 4.0F / 29;
    const float lightness = 116 * f[1] - 16, hunt = 0.01F * lightness;
    return {lightness, hunt * 500 * (f[0] - f[1]), hunt * 200 * (f[1] - f[2])};
}

/// Distance that is made for large differences (HyAB), raised to q_c.
float colour_distance(const Triple& a, const Triple& b)
{
    return std::pow(std::fabs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]), q_c);
}

/// To 0..1 for colours that distance apart, of which largest is the largest that there can be.
float colour_error(float distance, float largest)
{
    const float knee = p_c * largest;
    return distance < knee ? distance * p_t / knee : p_t + (distance - knee) / (largest - knee) * (1 - p_t);
}

// The eye.

/// A picture's opponent colours Y, X - Y and Y - Z. They are YCxCz without its factors and offset, which filters of sum
/// 1 keep as they are.
std::array<Plane, 3> opponents(const Picture& picture)
{
    std::array<Plane, 3> out;
    out.fill(make_plane(picture.width, picture.height));
    for (std::size_t i = 0; i < out[0].value.size(); ++i) {
        const float* p = picture.rgb.data() + 3 * i;
        const auto [x, y, z] = times(to_xyz, {within_0_and_1(p[0]), within_0_and_1(p[1]), within_0_and_1(p[2])});
        out[0].value[i] = y;
        out[1].value[i] = x - y;
        out[2].value[i] = y - z;
    }
    return out;
}

/// The contrast sensitivity of the eye as a filter: a sum of Gaussians a sqrt(pi/b) exp(-pi^2 r^2/b), r in degrees.
/// One of them; its weight is a sqrt(pi/b) (sum of exp)^2.
struct Gaussian {
    Kernel kernel;
    double weight;

    Gaussian(double a, double b, double pixels_per_degree)
    {
        using std::numbers::pi;
        constexpr double widest = 0.04; // of all b: one radius for all
        const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
        const double scale = pi * pi / (b * pixels_per_degree * pixels_per_degree);
        const auto weights = sample(radius, [scale](double k) { return std::exp(-scale * k * k); });
        double sum = 0;
        for (const double v : weights) sum += v;
        kernel = normalised(weights);
        weight = a * std::sqrt(pi / b) * sum * sum;
    }
};

/// Blurs what the eye cannot resolve.
void blur(std::array<Plane, 3>& opponent, double pixels_per_degree)
{
    opponent[0] = along_both(opponent[0], Gaussian(1, 0.0047, pixels_per_degree).kernel);
    opponent[1] = along_both(opponent[1], Gaussian(1, 0.0053, pixels_per_degree).kernel);
    const Gaussian wide(34.1, 0.04, pixels_per_degree), narrow(13.5, 0.025, pixels_per_degree);
    const auto share = static_cast<float>(wide.weight / (wide.weight + narrow.weight));
    const Plane other = along_both(opponent[2], narrow.kernel);
    opponent[2] = along_both(opponent[2], wide.kernel);
    for (std::size_t i = 0; i < other.value.size(); ++i)
        opponent[2].value[i] = share * opponent[2].value[i] + (1 - share) * other.value[i];
}

/// What the eye makes of a picture.
struct Seen {
    std::array<Plane, 3> opponent; ///< blurred
    Plane edge, point;             ///< how much of an edge, of a point, there is: 0..sqrt(2)

    Seen(const Picture& picture, double pixels_per_degree) : opponent(opponents(picture))
    {
        const double deviation = 0.5 * detector_width * pixels_per_degree, square = deviation * deviation;
        const int radius = static_cast<int>(std::ceil(3 * deviation));
        const auto g = [square](double k) { return std::exp(-k * k / (2 * square)); };
        const Kernel smooth = normalised(sample(radius, g));
        const Kernel first = normalised(sample(radius, [g](double k) { return -k * g(k); }));
        const Kernel second = normalised(sample(radius, [&](double k) { return (k * k / square - 1) * g(k); }));

        const Plane smoothed = along_rows(opponent[0], smooth);
        const auto detect = [&](const Kernel& detector) {
            return lengths(along_columns(along_rows(opponent[0], detector), smooth), along_columns(smoothed, detector));
        };
        edge = detect(first);
        point = detect(second);
        blur(opponent, pixels_per_degree);
    }

    Triple lab(std::size_t i) const
    {
        const float y = opponent[0].value[i];
        Triple rgb = times(from_xyz, {y + opponent[1].value[i], y, y - opponent[2].value[i]});
        for (float& v : rgb) v = within_0_and_1(v);
        return hunt_lab(rgb);
    }
};

float pixel_error(const Seen& a, const Seen& b, std::size_t i, float largest)
{
    const float colour = colour_error(colour_distance(a.lab(i), b.lab(i)), largest);
    const float edge = std::fabs(a.edge.value[i] - b.edge.value[i]);
    const float point = std::fabs(a.point.value[i] - b.point.value[i]);
    const float feature = std::pow(std::max(edge, point) / std::numbers::sqrt2_v<float>, q_f);
    return within_0_and_1(std::pow(colour, 1 - feature));
}

} // namespace

Flip flip(const Picture& a, const Picture& b, double pixels_per_degree)
{
    require_same_size(a, b);
    if (!(pixels_per_degree >= 1 && pixels_per_degree <= 1000))
        throw UsageError(fmt::format("{} pixels per degree are wrong, expected 1 to 1000", pixels_per_degree));
    Flip out{.error = make_plane(a.width, a.height)};
    if (out.error.value.empty()) return out;
    const float largest = colour_distance(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1}));
    const Seen seen_a(a, pixels_per_degree), seen_b(b, pixels_per_degree);
    double sum = 0;
    for (std::size_t i = 0; i < out.error.value.size(); ++i) {
        out.error.value[i] = pixel_error(seen_a, seen_b, i, largest);
        sum += out.error.value[i];
    }
    out.mean = sum / static_cast<double>(out.error.value.size());
    return out;
}

} // namespace clucida::host
