#include "host/motion.h"

#include "scene/error.h"

#include <fmt/format.h>

namespace clucida::host {

CompiledFrame Motion::compile(unsigned frame) const
{
    SceneOptions options = options_;
    options.moment.frame = frame;
    scene::Usage usage;
    const scene::Scene scene = read_moment(source_, options, &usage);
    CompiledFrame out;
    out.sequence = scene.sequence;
    out.moves = usage.time;
    for (const scene::View& view : eyes_of(stereo_, scene, view_))
        out.eyes.push_back(compile_scene(source_, scene, view, &photographs_));
    return out;
}

} // namespace clucida::host
