#include "scene/read.h"

#include "scene/limits.h"
#include "scene/read_common.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <memory>

namespace clucida::scene {
namespace {

namespace fs = std::filesystem;

struct CloseFile {
    void operator()(std::FILE* file) const
    {
        if (file != stdin) std::fclose(file);
    }
};

Error too_large(const std::string& name)
{
    return Error(fmt::format("{}: error: the text is larger than 256 MiB", name));
}

std::string read_all(std::FILE* file, const std::string& name)
{
    constexpr std::size_t piece = std::size_t{1} << 20;
    std::string text;
    while (true) {
        const std::size_t size = text.size();
        text.resize(size + piece);
        const std::size_t got = std::fread(text.data() + size, 1, piece, file);
        text.resize(size + got);
        if (std::ferror(file) != 0) {
            throw Error(fmt::format("{}: error: cannot be read: {}", name, std::strerror(errno)));
        }
        if (text.size() > limits::text_bytes) throw too_large(name);
        if (got == 0) return text;
    }
}

Location place_of(std::string_view text, std::size_t offset)
{
    const std::string_view before = text.substr(0, offset);
    const std::size_t line_start = before.rfind('\n') + 1; // npos + 1 is 0
    return {static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1, offset - line_start + 1};
}

} // namespace

Format format_of(const fs::path& file)
{
    if (file.extension() == ".gun") return Format::gun;
    if (file.extension() == ".rayt") return Format::rayt;
    return Format::clucida;
}

Scene read_scene(std::string_view text, const std::string& file, Format format, const fs::path& folder,
                 const ReadOptions& options, Usage* usage)
{
    if (text.size() > limits::text_bytes) throw too_large(file);
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    const Moment& moment = options.moment;
    const Source source{file, text, moment.frames > 1 ? fmt::format(" (in frame {})", moment.frame) : ""};
    if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
        source.fail(place_of(text, nul), "a NUL byte; expected text in UTF-8");
    }
    PhotographFinder photographs(source, folder, options);
    Usage used;
    if (format != Format::clucida && !moment.parameters.empty())
        throw Error(fmt::format("{}: error: scenes of this format have no parameters", file));
    switch (format) {
    case Format::gun: return read_gun(source, photographs);
    case Format::rayt: return read_rayt(source, photographs);
    case Format::clucida: break;
    }
    Scene scene = read_clucida(source, photographs, moment, used);
    if (usage != nullptr) *usage = used;
    return scene;
}

SceneText load_scene_text(const std::string& file, const ReadOptions& options)
{
    SceneText scene;
    scene.format = options.format.value_or(format_of(file));
    std::unique_ptr<std::FILE, CloseFile> stream;
    if (file == "-") {
        scene.file = "<stdin>";
        scene.folder = ".";
        stream.reset(stdin);
    } else {
        scene.file = file;
        scene.folder = fs::path(file).parent_path();
        if (scene.folder.empty()) scene.folder = ".";
        std::error_code error;
        if (fs::is_directory(file, error)) throw Error(fmt::format("{}: error: is a folder; expected a scene", file));
        stream.reset(std::fopen(file.c_str(), "rb"));
        if (stream == nullptr) {
            throw Error(fmt::format("{}: error: cannot be opened: {}", file, std::strerror(errno)));
        }
    }
    scene.text = read_all(stream.get(), scene.file);
    return scene;
}

Scene read_scene_file(const std::string& file, const ReadOptions& options)
{
    const SceneText scene = load_scene_text(file, options);
    return read_scene(scene.text, scene.file, scene.format, scene.folder, options);
}

} // namespace clucida::scene
