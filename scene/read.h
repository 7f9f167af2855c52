/// Readers: text to Scene. Three languages: clucida's own (docs/scene-language.md) and the original program's two
/// generations, gun (2016) and rayt (today's).
#pragma once

#include "scene/error.h"
#include "scene/model.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace clucida::scene {

enum class Format { clucida, gun, rayt };

/// By the file's ending: .gun, .rayt, else clucida's own.
Format format_of(const std::filesystem::path& file);

/// A frame of a sequence, and what the scene's parameters are: all that clucida's own texts may depend on.
struct Moment {
    unsigned frame = 1;                            ///< the first is 1
    unsigned frames = 0;                           ///< of the whole sequence; 0: as many as the scene says
    std::map<std::string, std::string> parameters; ///< expressions, by the parameter's name
};

/// What of its moment a text has asked for.
struct Usage {
    bool time = false; ///< t or frame: frames differ
};

struct ReadOptions {
    std::optional<Format> format;                    ///< else by the ending
    std::optional<std::filesystem::path> allow_path; ///< photographs may also lie beneath this folder
    Moment moment = {};
};

/// Reads the text of a scene. file names it in errors; photographs resolve beneath folder.
/// @throws Error with file:line:column
/// usage may be nullptr.
Scene read_scene(std::string_view text, const std::string& file, Format format, const std::filesystem::path& folder,
                 const ReadOptions& options = {}, Usage* usage = nullptr);

struct SceneText {
    std::string file; ///< as errors name it
    std::string text;
    Format format = Format::clucida;
    std::filesystem::path folder;
};
/// Reads a file's text, or standard input for "-" (photographs then resolve beneath the working folder).
/// @throws Error if it cannot be read or is larger than 256 MiB
SceneText load_scene_text(const std::string& file, const ReadOptions& options = {});

/// Both at once.
Scene read_scene_file(const std::string& file, const ReadOptions& options = {});

} // namespace clucida::scene
