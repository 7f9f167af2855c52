/// The scene compiler: a Scene and a view of it become flat buffers, laid out by kernels/layout.h, and the needs that
/// select the kernel variant.
#pragma once

#include "kernels/layout.h"
#include "scene/model.h"
#include "scene/needs.h"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace clucida::scene {

/// Which original program's behaviour to imitate (docs/original.md).
enum class AsOriginal { none, gun, rayt };

/// How the scene is looked at. max_hops and cutoff replace the scene's own when set.
struct View {
    unsigned width = 640, height = 360;
    unsigned samples = 1;
    std::optional<unsigned> max_hops; ///< 1..1000000
    std::optional<double> cutoff;     ///< 0..1
    AsOriginal as_original = AsOriginal::none;
};

struct Buffers {
    std::array<std::vector<std::byte>, BUFFER_COUNT> bytes; ///< in the order of LayoutBuffer; some may be empty
};

/// What `inspect` prints of one object.
struct ObjectReport {
    std::string name;
    std::size_t planes = 0, spheres = 0, quadrics = 0, tori = 0, groups = 0, program = 0;
    double radius = 0; ///< of the bound; infinite if there is none
    std::size_t bytes = 0;
};

struct Compiled {
    Buffers buffers;
    Needs needs;
    std::vector<ObjectReport> objects;
    std::size_t interior_bound =
        0; ///< the most objects that may hold one point; needs.interior may be less to begin with
};

/// Where the observer's eye is: the origin of the buffers' coordinates.
Vec3 eye_of(const Scene& scene);

/// @throws Error (scene/error.h) naming the statement, for what a scene's text could not show to be wrong:
/// a solid too large when expanded, a transform that flattens, a photograph that cannot be read.
Compiled compile(const Scene& scene, const View& view);

} // namespace clucida::scene
