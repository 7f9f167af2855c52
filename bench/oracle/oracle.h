/// The oracle: an independent tracer of the optical model (docs/optics.md), for tests and reports. It finds all
/// crossings along a ray, sorts them, and works out from geometry what holds each stretch between them. It shares no
/// code with the kernels. Real is double, long double, Quad or Big.
///
///     const auto world = oracle::build<oracle::Quad>(scene, {.view = view, .stored_colors = true});
///     const oracle::Path path = oracle::observe(world, x, y, sample);
#pragma once

#include "bench/oracle/path.h"
#include "bench/oracle/world.h"

#include <functional>
#include <span>

namespace clucida::oracle {

/// The path of the observer's ray through sample `sample` of pixel (x, y).
template <class Real>
Path observe(const World<Real>& world, unsigned x, unsigned y, unsigned sample);

/// The same for a ray from anywhere, in scene coordinates; d may have any length.
template <class Real>
Path follow(const World<Real>& world, const std::array<Real, 3>& o, const std::array<Real, 3>& d);

struct Pixel {
    unsigned x = 0, y = 0, sample = 0;
};

/// Their paths, in their order; the same for every number of threads.
template <class Real>
std::vector<Path> render(const World<Real>& world, std::span<const Pixel> pixels, unsigned threads);

/// A crossing that a ray may start in: it offers no more than its other roots.
struct Surface {
    std::uint32_t object = vacuum, face = vacuum;
    bool operator==(const Surface&) const = default;
};

/// Where the medium in force changes.
template <class Real>
struct Hit {
    Real t = 0;
    Vec<Real> point, normal; ///< the normal is of length 1 and points out of the object
    std::uint32_t object = vacuum, face = vacuum;
    std::uint32_t before = vacuum, after = vacuum; ///< the media in force: objects
    std::vector<Surface> surfaces;                 ///< all that are crossed there
};

/// The next surface that is optically there. left are the surfaces in which the ray starts (Hit::surfaces of where it
/// left); without them those within the tolerance of o count as such.
template <class Real>
std::optional<Hit<Real>> next(const World<Real>& world, const std::array<Real, 3>& o, const std::array<Real, 3>& d,
                              std::span<const Surface> left = {});

/// A ray to be traced, and what is left of the light by its start.
template <class Real>
struct Branch {
    std::array<Real, 3> o{}, d{}; ///< in scene coordinates; d may have any length
    std::vector<Surface> left;    ///< as for next()
    unsigned hop = 0;
    std::array<Real, 3> throughput{Real(1), Real(1), Real(1)}; ///< the product of the filters since the observer
};

/// A branch's first segment. What follows is not traced.
template <class Real>
struct Segment {
    std::optional<Event> event; ///< as a path that goes on from here has it; none if all would be black at once
    std::optional<Branch<Real>> reflected, refracted; ///< those that the event says are followed
};

template <class Real>
Segment<Real> segment(const World<Real>& world, const Branch<Real>& branch);

/// The observer's ray through sample `sample` of pixel (x, y).
template <class Real>
Branch<Real> observer_branch(const World<Real>& world, unsigned x, unsigned y, unsigned sample);

/// The branch as the world's disturbance has it: ray and throughput, each number by an h of its own, which the key
/// tells from those of other branches.
template <class Real>
Branch<Real> disturbed(const World<Real>& world, const Branch<Real>& branch, std::uint64_t key);

/// One primitive surface of an object: value is 0 on it, negative in the primitive's solid, of any scale.
struct Face {
    std::function<double(scene::Vec3)> value;
};
/// Of every object, in the order that events count faces by.
std::vector<std::vector<Face>> faces(const scene::Scene& scene);

} // namespace clucida::oracle
