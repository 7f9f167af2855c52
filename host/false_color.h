/// Numbers as colours, for maps of error.
#pragma once

#include "host/picture.h"
#include "host/plane.h"

namespace clucida::host {

/// What the ends of the colours stand for; least < most, and least > 0 if the scale is logarithmic.
struct Scale {
    double least = 0, most = 1;
    bool logarithmic = false;
};

/// Where a value lies on a scale: 0 (least or less) to 1 (most or more). NaN stays NaN.
double place_on_scale(double value, const Scale& scale);

/// matplotlib's colour map "magma" at 0..1: black, violet, orange, pale yellow, ever lighter, in steps that are even to
/// the eye. In linear light; the encoded channels are within 3 / 255 of matplotlib's.
std::array<float, 3> magma(double place);

/// A picture of the plane's size. What is not a number is pure green, which magma never is.
Picture false_color(const Plane& plane, const Scale& scale);

/// The picture with a strip of the colours beneath it and the values there: a label per power of ten on a logarithmic
/// scale, else one per quarter. Labels that would touch the one before are left out.
Picture with_legend(const Picture& picture, const Scale& scale);

} // namespace clucida::host
