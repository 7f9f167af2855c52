#include "host/scene_source.h"

#include "host/errors.h"
#include "host/sha256.h"
#include "scene/error.h"

#include <filesystem>
#include <future>
#include <optional>

namespace clucida::host {
namespace {

std::optional<scene::Format> format_of_name(const std::string& name)
{
    if (name.empty()) return std::nullopt;
    if (name == "clucida") return scene::Format::clucida;
    if (name == "gun") return scene::Format::gun;
    if (name == "rayt") return scene::Format::rayt;
    throw UsageError("there is no scene format '" + name + "'; expected clucida, gun or rayt");
}

scene::AsOriginal original_of(scene::Format format)
{
    switch (format) {
    case scene::Format::gun: return scene::AsOriginal::gun;
    case scene::Format::rayt: return scene::AsOriginal::rayt;
    case scene::Format::clucida: break;
    }
    throw UsageError("--as-original is for scenes of the original programs (gun, rayt); this one is clucida's own");
}

scene::ReadOptions read_options(const SceneOptions& options)
{
    scene::ReadOptions read;
    read.format = format_of_name(options.format);
    if (!options.allow_path.empty()) read.allow_path = options.allow_path;
    read.moment = options.moment;
    for (const std::string& text : options.parameters) {
        const auto equals = text.find('=');
        if (equals == 0 || equals == std::string::npos) throw UsageError("--set: '" + text + "' is no NAME=VALUE");
        const std::string name = text.substr(0, equals);
        if (!read.moment.parameters.emplace(name, text.substr(equals + 1)).second)
            throw UsageError("--set gives '" + name + "' twice");
    }
    return read;
}

} // namespace

SceneSource load_scene(const SceneOptions& options, scene::Usage* usage)
{
    SceneSource out;
    const std::filesystem::path path(options.file);
    out.name = path.filename().string();
    out.stem = options.file == "-" ? "picture" : path.stem().string();
    out.text = scene::load_scene_text(options.file, read_options(options));
    if (options.as_original) out.as_original = original_of(out.text.format);
    // Of large texts this takes a sixth of the time that reading does, which waits for nothing of it.
    auto hash = std::async(std::launch::async, sha256, std::string_view(out.text.text));
    out.scene = read_moment(out, options, usage);
    out.hash = hash.get();
    return out;
}

scene::Scene read_moment(const SceneSource& source, const SceneOptions& options, scene::Usage* usage)
{
    const scene::SceneText& text = source.text;
    return scene::read_scene(text.text, text.file, text.format, text.folder, read_options(options), usage);
}

scene::Compiled compile_scene(const SceneSource& source, const scene::Scene& scene, scene::View view,
                              scene::PhotographCache* photographs)
{
    view.as_original = source.as_original;
    if (view.as_original != scene::AsOriginal::none) {
        const bool gun = view.as_original == scene::AsOriginal::gun;
        if (!view.max_hops) view.max_hops = gun ? 6 : 19;
        if (!view.cutoff) view.cutoff = gun ? 0.1 : 1.0 / 256;
    }
    try {
        return scene::compile(scene, view, photographs);
    } catch (const scene::Error& e) {
        throw scene::located(e, source.text.file, source.text.text);
    }
}

} // namespace clucida::host
