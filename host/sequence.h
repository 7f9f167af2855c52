/// Frames of a sequence become files and a film: planned first, then rendered, while the next frame is compiled and the
/// last one encoded.
#pragma once

#include "host/film.h"
#include "host/fingerprint.h"
#include "host/frames.h"
#include "host/motion.h"
#include "host/renderer.h"

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace clucida::host {

struct FrameFiles {
    FramePattern pattern;
    FileFormat format = FileFormat::png;
};

struct FilmFile {
    std::string file;
    FilmFormat format = FilmFormat::mp4;
};

struct SequenceJob {
    const Motion* motion = nullptr;
    std::vector<unsigned> frames;
    RenderSettings settings;
    EncodeOptions encoding; ///< its metadata are completed by each frame's number and fingerprint
    std::optional<FrameFiles> files;
    std::optional<FilmFile> film;
    double fps = 24;
    bool skip_existing = false; ///< files that are whole and would be the same are kept
    unsigned in_flight = 3;     ///< frames that are compiled, traced or encoded at a time; 1: one thing after the other
};

struct PlannedFrame {
    unsigned frame = 1;
    std::vector<std::string> files; ///< of each eye of a pair; one if there is no pair; none for a film alone
    std::string fingerprint;
    bool kept = false;
};

struct SequencePlan {
    std::vector<PlannedFrame> frames;
    scene::Needs needs; ///< of all that are to be rendered
    std::size_t kept = 0;
    bool moves = false; ///< false: all frames are the same picture
};

/// Compiles every frame once, so that all that is wrong with any is known before the first is rendered, and one build
/// of the kernels serves them all.
/// @throws scene::Error, which names the frame; UsageError if two frames have the same file
SequencePlan plan_sequence(const SequenceJob& job, const std::function<bool()>& cancelled);

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
