#include "host/commands.h"
#include "scene/limits.h"
#include "scene/report.h"
#include "scene/write.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <iostream>
#include <map>
#include <memory>

namespace clucida::host {
namespace {

struct InspectOptions {
    SceneOptions scene;
    bool json = false, print = false;
};

constexpr const char* buffer_names[] = {"frame",    "nodes",  "objects", "groups",   "members", "programs",
                                        "planes",   "blocks", "spheres", "quadrics", "tori",    "optics",
                                        "textures", "images", "texels",  "lights"};

std::vector<std::string> feature_list(const scene::Needs& needs)
{
    std::vector<std::string> out;
    for (const scene::FeatureName& f : scene::feature_names())
        if (needs.features & f.feature) out.emplace_back(f.name);
    return out;
}

using Reports = std::vector<scene::ObjectReport>;

double per_object(const scene::Compiled& compiled, const Reports& objects)
{
    const auto count = static_cast<double>(std::max<std::size_t>(objects.size(), 1));
    return static_cast<double>(scene::byte_count(compiled.buffers)) / count;
}

/// Objects made of the same kinds of primitives.
struct Kind {
    std::size_t objects = 0, bytes = 0;
};

std::map<std::string, Kind> kinds_of(const Reports& objects)
{
    std::map<std::string, Kind> out;
    for (const scene::ObjectReport& o : objects) {
        std::string name;
        const auto add = [&](std::size_t count, const char* what) {
            if (count) name += fmt::format("{}{}", name.empty() ? "" : "+", what);
        };
        add(o.planes, "planes");
        add(o.spheres, "spheres");
        add(o.quadrics, "quadrics");
        add(o.tori, "tori");
        Kind& kind = out[name.empty() ? "nothing" : name];
        ++kind.objects;
        kind.bytes += o.bytes;
    }
    return out;
}

nlohmann::ordered_json object_json(const scene::ObjectReport& o)
{
    nlohmann::ordered_json j = {{"name", o.name},       {"groups", o.groups},     {"planes", o.planes},
                                {"spheres", o.spheres}, {"quadrics", o.quadrics}, {"tori", o.tori},
                                {"program", o.program}, {"radius", nullptr},      {"bytes", o.bytes}};
    if (std::isfinite(o.radius)) j["radius"] = o.radius;
    return j;
}

nlohmann::ordered_json to_json(const SceneSource& source, const scene::Compiled& compiled, const Reports& reports)
{
    nlohmann::ordered_json kinds = nlohmann::ordered_json::object(), buffers;
    for (const auto& [name, kind] : kinds_of(reports)) kinds[name] = {{"objects", kind.objects}, {"bytes", kind.bytes}};
    for (std::size_t i = 0; i < BUFFER_COUNT; ++i) buffers[buffer_names[i]] = compiled.buffers.bytes[i].size();
    const scene::Needs& needs = compiled.needs;
    return {{"scene", source.name},
            {"sha256", source.hash},
            {"features", feature_list(needs)},
            {"capacities",
             {{"interior", needs.interior}, {"stack", needs.stack}, {"groups", needs.groups}, {"walk", needs.walk}}},
            {"interior_bound", compiled.interior_bound},
            {"options", scene::build_options(needs)},
            {"buffers", std::move(buffers)},
            {"total_bytes", scene::byte_count(compiled.buffers)},
            {"bytes_per_object", per_object(compiled, reports)},
            {"kinds", std::move(kinds)}};
}

std::string dumped(const nlohmann::ordered_json& j, int indent)
{
    return j.dump(indent, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// The objects come last, one by one: a million of them are more than a gigabyte as values of JSON.
void print_json(const SceneSource& source, const scene::Compiled& compiled, const Reports& objects)
{
    std::string text = dumped(to_json(source, compiled, objects), 2);
    text.resize(text.size() - 2); // but for the end of line and the brace
    fmt::print("{},\n  \"objects\": [", text);
    const char* separator = "";
    for (const scene::ObjectReport& o : objects) {
        fmt::print("{}\n    {}", separator, dumped(object_json(o), -1));
        separator = ",";
    }
    fmt::print("\n  ]\n}}\n");
}

void print(const SceneSource& source, const scene::Compiled& compiled, const Reports& objects)
{
    const scene::Needs& needs = compiled.needs;
    fmt::print("{}: {} objects, {} lights\n\n", source.name, objects.size(), source.scene.lights.size());
    fmt::print("{:<24} {:>7} {:>7} {:>8} {:>9} {:>6} {:>12} {:>8}\n", "object", "groups", "planes", "spheres",
               "quadrics", "tori", "radius", "bytes");
    for (const scene::ObjectReport& o : objects)
        fmt::print("{:<24} {:>7} {:>7} {:>8} {:>9} {:>6} {:>12.6g} {:>8}\n", o.name.empty() ? "-" : o.name, o.groups,
                   o.planes, o.spheres, o.quadrics, o.tori, o.radius, o.bytes);
    fmt::print("\n{:<24} {:>7} {:>12} {:>10}\n", "objects of", "count", "bytes", "each");
    for (const auto& [name, kind] : kinds_of(objects))
        fmt::print("{:<24} {:>7} {:>12} {:>10.1f}\n", name, kind.objects, kind.bytes,
                   static_cast<double>(kind.bytes) / static_cast<double>(kind.objects));
    fmt::print("\nfeatures   {}\n", fmt::join(feature_list(needs), " "));
    fmt::print("capacities interior {} (of at most {}), stack {}, groups {}\n", needs.interior, compiled.interior_bound,
               needs.stack, needs.groups);
    fmt::print("options    {}\n\n", scene::build_options(needs));
    for (std::size_t i = 0; i < BUFFER_COUNT; ++i)
        if (!compiled.buffers.bytes[i].empty())
            fmt::print("{:<10} {:>12} bytes\n", buffer_names[i], compiled.buffers.bytes[i].size());
    fmt::print("{:<10} {:>12} bytes, {:.1f} an object\n", "total", scene::byte_count(compiled.buffers),
               per_object(compiled, objects));
}

void run(const InspectOptions& options)
{
    const SceneSource source = load_scene(options.scene);
    if (options.print) {
        std::cout << scene::print_scene(source.scene);
        return;
    }
    const scene::Compiled compiled = compile_scene(source, {});
    const Reports objects = scene::report_objects(source.scene, compiled.buffers);
    if (options.json)
        print_json(source, compiled, objects);
    else
        print(source, compiled, objects);
}

} // namespace

void add_inspect(CLI::App& app)
{
    auto options = std::make_shared<InspectOptions>();
    CLI::App* command = app.add_subcommand("inspect", "Tell what a scene needs: objects, features, bytes");
    add_scene_options(*command, options->scene);
    command->add_option("--frame", options->scene.moment.frame, "of a sequence; else the first")
        ->check(number_within(1, scene::limits::frames))
        ->option_text("N");
    command->add_flag("--json", options->json, "as JSON");
    command->add_flag("--print", options->print, "write the scene as canonical text and nothing else");
    command->footer("Examples:\n  clucida inspect scene.clu\n  clucida inspect old.rayt --print > new.clu");
    command->callback([options] { run(*options); });
}

} // namespace clucida::host
