/// Frames of a sequence become files and a film: rendered as planned, while the next frame is compiled and the last one
/// encoded.
#pragma once

#include "host/sequence_plan.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace clucida::host {

/// What a frame took, when it has been written.
struct FrameReport {
    const PlannedFrame* planned = nullptr;
    Statistics statistics;
    Timings timings; ///< of all eyes
    std::string device = {};
    std::vector<std::string> notes = {};
};

struct SequenceReport {
    std::size_t rendered = 0;
    unsigned builds = 0; ///< of the kernels, on all devices
    double seconds = 0;
    Timings timings; ///< of all frames
};

struct SequenceHooks {
    std::function<void(double fraction)> progress = {}; ///< of the frames that are traced, in sum
    std::function<bool()> cancelled = {};               ///< asked between launches
    /// From a thread of its own, in order unless the work has ended early.
    std::function<void(const FrameReport&)> finished = {};
};

/// Of several devices, each renders whole frames, from the second on, and all share the last ones: the pictures do not
/// depend on that where their arithmetic agrees. in_flight 1: they share every frame. A device that fails leaves its
/// frame to the others.
/// @throws Failure, Interrupted; frames that were finished before are kept, a film is not
SequenceReport render_sequence(const SequenceJob& job, const SequencePlan& plan, std::span<Renderer> team,
                               const SequenceHooks& hooks);

} // namespace clucida::host
