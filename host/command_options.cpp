#include "host/commands.h"

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
    command.add_flag("--as-original", options.as_original,
                     "imitate the original program of the scene's format, defects included");
}

} // namespace clucida::host
