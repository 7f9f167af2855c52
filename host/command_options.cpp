#include "host/commands.h"

#include "scene/limits.h"

#include <fmt/format.h>

namespace clucida::host {

CLI::Validator number_within(double least, double most)
{
    const auto check = [least, most](const std::string& text) -> std::string {
        double value = 0;
        if (CLI::detail::lexical_cast(text, value) && value >= least && value <= most) return {};
        return fmt::format("'{}' is wrong, expected a number within {} and {}", text, least, most);
    };
    return {check, "", ""};
}

void add_scene_options(CLI::App& command, SceneOptions& options)
{
    command.add_option("scene", options.file, "the scene's file, or - for standard input")
        ->required()
        ->option_text("SCENE");
    command.add_option("--format", options.format, "of the scene: clucida, gun or rayt; else by the file's ending")
        ->option_text("NAME");
    command.add_option("--allow-path", options.allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command.add_option("--set", options.parameters, "another value for a parameter of the scene; any number of times")
        ->option_text("NAME=VALUE")
        ->allow_extra_args(false);
    command
        .add_option("--frame-count", options.moment.frames,
                    "of the whole sequence, over which the scene's t goes from 0 to 1; else as the scene says")
        ->check(number_within(1, scene::limits::frames))
        ->option_text("N");
    command.add_flag("--as-original", options.as_original,
                     "imitate the original program of the scene's format, defects included");
}

} // namespace clucida::host
