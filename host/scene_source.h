/// A scene as the command line names it: read, and compiled for a view.
#pragma once

#include "scene/compile.h"
#include "scene/read.h"

#include <string>
#include <vector>

namespace clucida::host {

/// The options that `render` and `inspect` share.
struct SceneOptions {
    std::string file;       ///< "-": standard input
    std::string format;     ///< "clucida", "gun", "rayt", or empty: by the ending
    std::string allow_path; ///< photographs may lie beneath this folder too; or empty
    bool as_original = false;
    std::vector<std::string> parameters = {}; ///< NAME=VALUE, for those of the scene; moment's are made of them
    scene::Moment moment = {};                ///< which frame of the scene
};

struct SceneSource {
    std::string name; ///< the file's own name, without folders; "-" for standard input
    std::string stem; ///< of a picture's name
    std::string hash; ///< SHA-256 of the text
    scene::SceneText text;
    scene::Scene scene;
    scene::AsOriginal as_original = scene::AsOriginal::none;
};

/// The scene at options.moment. usage may be nullptr.
/// @throws scene::Error with the place, UsageError for --as-original with clucida's own format
SceneSource load_scene(const SceneOptions& options, scene::Usage* usage = nullptr);

/// The source's text, which load_scene has read for the same options, at another moment. @throws scene::Error
scene::Scene read_moment(const SceneSource& source, const SceneOptions& options, scene::Usage* usage);

/// view.as_original is set, and with it the original's hops and cutoff where the view has none. The scene is source's
/// own, at whatever moment. @throws scene::Error with the place
scene::Compiled compile_scene(const SceneSource& source, const scene::Scene& scene, scene::View view,
                              scene::PhotographCache* photographs = nullptr);
inline scene::Compiled compile_scene(const SceneSource& source, const scene::View& view)
{
    return compile_scene(source, source.scene, view);
}

} // namespace clucida::host
