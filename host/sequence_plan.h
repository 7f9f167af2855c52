/// Which frames of a sequence become which files and films, and what is to be rendered for that.
#pragma once

#include "host/film.h"
#include "host/frames.h"
#include "host/motion.h"
#include "host/picture_file.h"
#include "host/renderer.h"

#include <functional>
#include <optional>
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

} // namespace clucida::host
