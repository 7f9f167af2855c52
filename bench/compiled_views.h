/// A scene as several views of it compile, for contenders that change from one to another.
#pragma once

#include "bench/speed_task.h"
#include "scene/compile.h"

#include <utility>
#include <vector>

namespace clucida::bench {

/// Holds what the last view compiled to: views follow each other seldom, and scenes may be large.
class CompiledViews {
public:
    /// @throws host::UsageError, scene::Error
    explicit CompiledViews(const SpeedTask& task);

    /// The buffers for the view, with the needs that were kept for it. Valid until another view is asked for.
    const scene::Compiled& at(const SpeedView& view);
    /// What a rendering of the view that at() was last asked for proved to need.
    void keep(const scene::Needs& needs);

private:
    host::SceneSource source_;
    scene::PhotographCache photographs_;
    unsigned least_interior_, least_stack_;
    SpeedView view_;
    scene::Compiled compiled_;
    bool ready_ = false;
    std::vector<std::pair<SpeedView, scene::Needs>> kept_;
};

} // namespace clucida::bench
