#include "bench/commands.h"
#include "bench/worker_process.h"
#include "host/interrupt.h"
#include "host/scene_source.h"
#include "host/signatures.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <bit>
#include <optional>

namespace clucida::bench {
namespace {

using Json = nlohmann::json;

/// The hashes of all pixels' paths, row by row.
Json paths_of(host::Renderer& renderer, const scene::Compiled& compiled, const host::Frame& frame,
              const host::RenderSettings& settings)
{
    std::vector<host::Pixel> pixels;
    for (unsigned y = 0; y < settings.picture.height; ++y)
        for (unsigned x = 0; x < settings.picture.width; ++x) pixels.push_back({x, y});
    host::PathTracer tracer = host::make_path_tracer(renderer, compiled, frame.needs, settings);
    host::Statistics statistics;
    Json out = Json::array();
    for (const host::PixelPath& path : host::trace_paths(tracer, pixels, 0, 0, statistics)) out.push_back(path.hash);
    return out;
}

Json render(std::optional<host::Renderer>& renderer, const Json& request)
{
    if (!renderer) renderer = host::make_renderer(host::find_device(request.at("device").get<std::string>()));
    const bool twofold = request.at("double").get<bool>();
    Json out = {{"device", host::describe(renderer->device.info)}};
    if (twofold && !renderer->device.info.has_double) return out;
    const host::SceneSource source =
        host::load_scene({request.at("scene").get<std::string>(), "", request.at("allow_path").get<std::string>()});
    host::RenderSettings settings;
    settings.picture = {request.at("width").get<unsigned>(), request.at("height").get<unsigned>()};
    settings.samples = request.at("samples").get<unsigned>();
    settings.precision = twofold ? host::Precision::twofold : host::Precision::single;
    settings.kernel = request.at("packets").get<bool>() ? host::KernelShape::packets : host::KernelShape::pixels;
    settings.tile = settings.picture;
    const scene::Compiled compiled =
        host::compile_scene(source, {settings.picture.width, settings.picture.height, settings.samples, {}, {}, {}});
    const host::Frame frame = host::render_frame(*renderer, compiled, settings, {{}, host::interrupted});
    Json rgb = Json::array();
    for (const float value : frame.picture.rgb) rgb.push_back(std::bit_cast<std::uint32_t>(value));
    out["rgb"] = std::move(rgb);
    out["faults"] = host::describe_faults(frame.statistics);
    if (request.at("paths").get<bool>() && !renderer->device.info.native) // whose kernels tell none
        out["paths"] = paths_of(*renderer, compiled, frame, settings);
    return out;
}

void run()
{
    std::optional<host::Renderer> renderer;
    serve([&](const Json& request) { return render(renderer, request); });
}

} // namespace

void add_agreement_worker(CLI::App& app)
{
    CLI::App* command =
        app.add_subcommand("agreement-worker", "A place of `agreement`, told what to do by JSON in lines");
    command->group(""); // not for people
    command->callback(run);
}

} // namespace clucida::bench
