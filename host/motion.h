/// A scene in time: its text, compiled for one frame of a sequence or another.
#pragma once

#include "host/scene_source.h"
#include "host/stereo.h"
#include "scene/photograph.h"

#include <string>
#include <vector>

namespace clucida::host {

/// A frame, compiled for each eye that sees it.
struct CompiledFrame {
    std::vector<scene::Compiled> eyes; ///< the left one first; one if there is no stereo
    scene::Sequence sequence;          ///< as the scene states it
    bool moves = false;                ///< the text depends on the frame
};

class Motion {
public:
    /// source is the text, which is read anew for each frame; options.moment.frame is not looked at.
    Motion(SceneSource source, const SceneOptions& options, const scene::View& view, const Stereo& stereo)
        : source_(std::move(source)), options_(options), view_(view), stereo_(stereo)
    {
    }

    /// Of use to several threads at a time. @throws scene::Error, which names the frame
    CompiledFrame compile(unsigned frame) const;

    const SceneSource& source() const { return source_; }
    const scene::View& view() const { return view_; }
    const Stereo& stereo() const { return stereo_; }

private:
    SceneSource source_;
    SceneOptions options_;
    scene::View view_;
    Stereo stereo_;
    mutable scene::PhotographCache photographs_;
};

} // namespace clucida::host
