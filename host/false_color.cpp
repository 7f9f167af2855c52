#include "host/false_color.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace clucida::host {
namespace {

/// Every 16th colour of matplotlib 3.11's "magma", 8-bit sRGB (N. J. Smith, S. van der Walt, E. Firing; CC0).
constexpr std::array<std::array<std::uint8_t, 3>, 17> magma_points = {{{0, 0, 4},
                                                                       {10, 8, 34},
                                                                       {29, 17, 70},
                                                                       {54, 16, 106},
                                                                       {80, 18, 124},
                                                                       {105, 28, 129},
                                                                       {130, 38, 129},
                                                                       {156, 46, 127},
                                                                       {182, 55, 121},
                                                                       {207, 65, 112},
                                                                       {230, 81, 99},
                                                                       {245, 105, 92},
                                                                       {251, 135, 97},
                                                                       {254, 165, 113},
                                                                       {254, 195, 135},
                                                                       {253, 224, 162},
                                                                       {252, 253, 191}}};

/// Characters of 3 x 5 dots, each row's dots in an octal digit, the top row first.
struct Glyph {
    char character;
    unsigned rows;
};
constexpr Glyph glyphs[] = {{'0', 075557}, {'1', 026227}, {'2', 071747}, {'3', 071717}, {'4', 055711},
                            {'5', 074717}, {'6', 074757}, {'7', 071111}, {'8', 075757}, {'9', 075717},
                            {'.', 000002}, {'-', 000700}, {'+', 002720}, {'e', 007747}};
constexpr unsigned glyph_width = 3, glyph_height = 5, glyph_step = 4;
constexpr unsigned dot = 2;                                     ///< pixels a side of a glyph's dot
constexpr unsigned strip_height = 10, tick_height = 4, gap = 2; ///< of the legend, pixels
constexpr unsigned legend_height = gap + strip_height + tick_height + gap + dot * glyph_height + gap;

using Color = std::array<float, 3>;

void set(Picture& picture, unsigned x, unsigned y, const Color& color)
{
    if (x >= picture.width || y >= picture.height) return;
    std::copy(color.begin(), color.end(),
              picture.rgb.begin() + std::ptrdiff_t{3} * (std::size_t{y} * picture.width + x));
}

void draw_glyph(Picture& picture, unsigned left, unsigned top, unsigned rows)
{
    for (unsigned y = 0; y < dot * glyph_height; ++y)
        for (unsigned x = 0; x < dot * glyph_width; ++x) {
            const unsigned row = rows >> (3 * (glyph_height - 1 - y / dot));
            if (row >> (glyph_width - 1 - x / dot) & 1) set(picture, left + x, top + y, {1, 1, 1});
        }
}

void draw_text(Picture& picture, unsigned left, unsigned top, const std::string& text)
{
    for (const char c : text) {
        for (const Glyph& glyph : glyphs)
            if (glyph.character == c) draw_glyph(picture, left, top, glyph.rows);
        left += dot * glyph_step;
    }
}

/// The values that get a label.
std::vector<double> labelled(const Scale& scale)
{
    std::vector<double> out;
    if (scale.logarithmic)
        for (double e = std::ceil(std::log10(scale.least) - 1e-9); e <= std::log10(scale.most) + 1e-9; ++e)
            out.push_back(std::pow(10, e));
    else
        for (int i = 0; i <= 4; ++i) out.push_back(scale.least + (scale.most - scale.least) * i / 4);
    return out;
}

} // namespace

double place_on_scale(double value, const Scale& scale)
{
    const double place = scale.logarithmic ? std::log(value / scale.least) / std::log(scale.most / scale.least)
                                           : (value - scale.least) / (scale.most - scale.least);
    if (std::isnan(value)) return value;
    return place > 0 ? std::min(place, 1.0) : 0; // the logarithm of what is negative is not a number
}

std::array<float, 3> magma(double place)
{
    const double at = std::clamp(place, 0.0, 1.0) * (magma_points.size() - 1);
    const auto i = std::min(static_cast<std::size_t>(at), magma_points.size() - 2);
    const double part = at - static_cast<double>(i);
    Color out;
    for (std::size_t c = 0; c < 3; ++c)
        out[c] =
            static_cast<float>(srgb_decode((magma_points[i][c] * (1 - part) + magma_points[i + 1][c] * part) / 255));
    return out;
}

Picture false_color(const Plane& plane, const Scale& scale)
{
    Picture out = make_picture(plane.width, plane.height);
    for (std::size_t i = 0; i < plane.value.size(); ++i) {
        const double place = place_on_scale(plane.value[i], scale);
        const Color color = std::isnan(place) ? Color{0, 1, 0} : magma(place);
        std::copy(color.begin(), color.end(), out.rgb.begin() + std::ptrdiff_t{3} * i);
    }
    return out;
}

Picture with_legend(const Picture& picture, const Scale& scale)
{
    Picture out = make_picture(picture.width, picture.height + legend_height);
    std::copy(picture.rgb.begin(), picture.rgb.end(), out.rgb.begin());
    const unsigned last = std::max(picture.width, 2U) - 1, strip = picture.height + gap;
    for (unsigned x = 0; x < picture.width; ++x) {
        const Color color = magma(static_cast<double>(x) / last);
        for (unsigned y = 0; y < strip_height; ++y) set(out, x, strip + y, color);
    }
    unsigned free = 0; // from here on no label has been drawn
    for (const double value : labelled(scale)) {
        const auto x = static_cast<unsigned>(std::lround(place_on_scale(value, scale) * last));
        for (unsigned y = 0; y < tick_height; ++y) set(out, x, strip + strip_height + y, {1, 1, 1});
        const std::string text = fmt::format("{:g}", value);
        const auto width = static_cast<unsigned>(text.size()) * dot * glyph_step;
        const unsigned middle = x > width / 2 ? x - width / 2 : 0;
        const unsigned left = std::min(middle, picture.width > width ? picture.width - width : 0);
        if (left < free || width > picture.width) continue;
        draw_text(out, left, strip + strip_height + tick_height + gap, text);
        free = left + width;
    }
    return out;
}

} // namespace clucida::host
