/// FLIP: how much two pictures differ to one who looks at them in turns, pixel by pixel.
///
/// P. Andersson, J. Nilsson, T. Akenine-Moeller, M. Oskarsson, K. Astroem, M. D. Fairchild: "FLIP: A Difference
/// Evaluator for Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. This is its form for
/// pictures of low dynamic range. The filters are applied separably, as in the authors' program.
#pragma once

#include "host/picture.h"
#include "host/plane.h"

namespace clucida::host {

/// Seen from 0.7 m on a screen that is 0.7 m wide and has 3840 pixels across: the paper's conditions.
constexpr double flip_pixels_per_degree = 0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180;

struct Flip {
    Plane error;     ///< 0 (not to be told apart) to 1
    double mean = 0; ///< over all pixels
};

/// Linear light is clamped to 0..1; what is not a number counts as black. Exchanging a and b changes nothing.
/// pixels_per_degree (of visual angle) lies within 1 and 1000: more of them, and finer detail is forgiven.
/// @throws Failure if the sizes differ, UsageError for other pixels_per_degree
Flip flip(const Picture& a, const Picture& b, double pixels_per_degree = flip_pixels_per_degree);

} // namespace clucida::host
