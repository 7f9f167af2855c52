/// One name for each surface: the kernels name primitives by where they lie in the buffers, the oracle by their order
/// in the scene. They are matched by what they are: functions with the same zeros.
#pragma once

#include "bench/oracle/oracle.h"
#include "scene/compile.h"

#include <map>
#include <vector>

namespace clucida::bench {

/// Of each object: the oracle's face for a primitive of the kernels (a reference without its inverse bit), and the
/// first of the oracle's faces that is the same surface as a given one.
struct FaceNames {
    struct OfObject {
        std::map<u32, u32> of_kernel;
        std::vector<u32> of_oracle;
    };
    std::vector<OfObject> objects;

    /// The events with their faces named so. @throws std::out_of_range for a face that the object has not
    std::vector<oracle::Event> kernel(std::span<const LayoutEvent> events) const;
    std::vector<oracle::Event> oracle(std::span<const oracle::Event> events) const;
};

FaceNames match_faces(const scene::Scene& scene, const scene::Compiled& compiled);

} // namespace clucida::bench
