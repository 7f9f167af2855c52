/// `render` of several frames, of a film, or for two eyes.
#pragma once

#include "host/render_options.h"
#include "host/sequence.h"

namespace clucida::host {

/// Where frames go, and which are named.
struct FrameTargets {
    std::optional<std::vector<unsigned>> named; ///< by --frames
    unsigned repeated = 0;                      ///< frames that were named twice
    std::optional<FrameFiles> files;
    std::optional<FilmFile> film;
    bool several = false; ///< something is asked for that only sequences have
};

/// @throws UsageError
FrameTargets frame_targets(const RenderOptions& o);

/// Whether the scene's frames are to be rendered, not a single picture of it.
bool is_sequence(const FrameTargets& targets, const scene::Sequence& sequence, const RenderOptions& o);

/// @throws what sequence.h names
void render_frames(const RenderOptions& o, SceneSource source, const FrameTargets& targets);

} // namespace clucida::host
