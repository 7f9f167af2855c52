#include "tests/fuzz/reader.h"

#include "scene/compile.h"
#include "scene/write.h"

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <unordered_map>

namespace clucida::fuzz {
namespace {

using namespace scene;

/// Primitives of all objects together, above which a scene is left alone: named solids double at each use, so a short
/// text can ask for more than there is time for. The readers' own limits have tests of their own.
constexpr std::size_t most_primitives = 2000;

class Size {
public:
    std::size_t of(const Scene& scene)
    {
        std::size_t sum = 0;
        for (const Object& object : scene.objects) sum += of(*object.solid);
        return sum;
    }

private:
    std::size_t of(const Solid& solid)
    {
        if (const auto known = known_.find(&solid); known != known_.end()) return known->second;
        const std::size_t size = std::visit([this](const auto& node) { return of_node(node); }, solid.node);
        known_.emplace(&solid, size);
        return size;
    }
    std::size_t of_list(const std::vector<SolidPtr>& list)
    {
        std::size_t sum = 0;
        for (const SolidPtr& solid : list) sum += of(*solid);
        return sum;
    }
    std::size_t of_node(const Complement& node) { return of(*node.of); }
    std::size_t of_node(const Transformed& node) { return of(*node.of); }
    std::size_t of_node(const Intersection& node) { return of_list(node.of); }
    std::size_t of_node(const Union& node) { return of_list(node.of); }
    std::size_t of_node(const Difference& node) { return of(*node.from) + of(*node.take); }
    template <typename Primitive>
    std::size_t of_node(const Primitive& /*primitive*/)
    {
        return 1;
    }

    std::unordered_map<const Solid*, std::size_t> known_;
};

const std::filesystem::path folder(CLUCIDA_TEST_DATA "/scenes");

[[noreturn]] void stop(const char* what, const std::string& text)
{
    std::fprintf(stderr, "%s:\n%s\n", what, text.c_str());
    std::abort();
}

void check_printed(const Scene& scene)
{
    const std::string text = print_scene(scene);
    try {
        const Scene back = read_scene(text, "printed", Format::clucida, folder);
        if (!(back == scene)) stop("the printed scene is another one", text);
        if (print_scene(back) != text) stop("printed again, the text is another one", text);
    } catch (const Error& error) {
        stop(error.what(), text);
    }
}

void check_compiled(const Scene& scene, AsOriginal as_original)
{
    View view;
    view.width = 16;
    view.height = 9;
    view.as_original = as_original;
    try {
        compile(scene, view);
    } catch (const Error& error) {
        if (*error.what() == '\0') stop("an error that says nothing", "");
    }
}

} // namespace

void try_text(const std::uint8_t* data, std::size_t size, Format format)
{
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const Scene scene = read_scene(text, "text", format, folder);
        if (Size().of(scene) > most_primitives) return;
        check_printed(scene);
        check_compiled(scene, AsOriginal::none);
        if (format == Format::gun) check_compiled(scene, AsOriginal::gun);
        if (format == Format::rayt) check_compiled(scene, AsOriginal::rayt);
    } catch (const Error& error) {
        if (std::string_view(error.what()).substr(0, 5) != "text:") stop("an error without its place", error.what());
    }
}

} // namespace clucida::fuzz
