/// How long frames take by packets of rays: pool_frames scenes... -s 640x360 prints a table of a frame's time in the
/// product's kernel and in the experiment's (README.md), and of how far their pictures are apart.
///
/// The two take turns, and each is rendered once before, so that compilation counts for nothing. What counts is the
/// processor's time of a trace, of all threads; POCL_MAX_PTHREAD_COUNT=1 in the environment makes PoCL take one.

#include "bench/median.h"
#include "host/arguments.h"
#include "host/compare.h"
#include "host/devices.h"
#include "host/errors.h"
#include "host/renderer.h"
#include "host/scene_source.h"
#include "host/statistics.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdlib>

extern const char* const clucida_pool_table[]; // made by kernels/embed.cmake

namespace clucida::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    std::string size = "640x360", device;
    unsigned samples = 1, rounds = 11, lanes = 8;
    bool as_original = false;
};

/// The product's kernels with the entry point of the experiment.
host::FileTexts pool_kernels(unsigned lanes)
{
    const std::string entry = fmt::format("#define POOL_WIDTH {}\n#include \"kernels/pool.cl\"\n", lanes);
    return [entry](const std::string& path) -> std::optional<std::string_view> {
        if (path == "kernels/render.cl") return entry;
        for (const char* const* file = clucida_pool_table; *file; file += 2)
            if (path == file[0]) return file[1];
        return host::embedded_kernel(path);
    };
}

struct Contender {
    host::Renderer renderer;
    host::RenderSettings settings;
    double compilation = 0; ///< s, where no cache had the program
    std::vector<double> seconds;
    host::Frame frame; ///< the last
};

Contender make_contender(const host::Device& device, const Options& o, host::FileTexts kernels)
{
    Contender c;
    c.renderer = host::make_renderer(device);
    c.settings.picture = host::parse_picture_size(o.size);
    c.settings.samples = o.samples;
    c.settings.tile = c.settings.picture; // one launch, and no time spent on choosing
    c.settings.kernels = std::move(kernels);
    return c;
}

void render(Contender& c, const scene::Compiled& compiled)
{
    c.frame = host::render_frame(c.renderer, compiled, c.settings);
    c.seconds.push_back(c.frame.timings.trace_cpu);
}

/// @throws host::Failure naming what of the scene the packets cannot do
void require_done(const scene::Compiled& compiled)
{
    constexpr std::uint32_t missing = scene::feature_torus;
    std::string names;
    for (const scene::FeatureName& f : scene::feature_names())
        if (compiled.needs.features & missing & f.feature) names += std::string(" ") + f.name;
    if (!names.empty()) throw host::Failure("the pool has no" + names);
}

void measure(const std::string& file, Contender& product, Contender& pool, const Options& o)
{
    const host::SceneSource source = host::load_scene({file, "", "", o.as_original});
    const host::Shape size = product.settings.picture;
    scene::Compiled compiled =
        host::compile_scene(source, {size.width, size.height, o.samples, {}, {}, source.as_original});
    require_done(compiled);
    for (Contender* c : {&product, &pool}) {
        render(*c, compiled);
        c->compilation = c->frame.timings.build + c->frame.timings.first_enqueue;
        compiled.needs = c->frame.needs; // no frame that counts is begun again for want of capacity
    }
    for (Contender* c : {&product, &pool}) {
        render(*c, compiled);
        c->seconds.clear();
    }
    if (pool.frame.statistics.stack_overflow) throw host::Failure("a stack of the pool overflowed");
    for (unsigned round = 0; round < o.rounds; ++round)
        for (Contender* c : {&product, &pool}) render(*c, compiled);

    const host::Statistics& counts = pool.frame.statistics;
    const double ours = median(product.seconds), theirs = median(pool.seconds);
    const auto far = host::compare(product.frame.picture, pool.frame.picture, 1.0 / 255);
    const auto apart = host::compare(product.frame.picture, pool.frame.picture, 2e-6);
    fmt::print("| {} | {} | {:.2f} | {:.1f} | {:.1f} | {:.2f} | {} | {} | {:.2g} | {:.1f} | {:.1f} |\n", source.name,
               counts.rays, 100.0 * static_cast<double>(counts.queries) / static_cast<double>(counts.rays), 1e3 * ours,
               1e3 * theirs, ours / theirs, far.over, apart.over, far.rmse, product.compilation, pool.compilation);
    std::fflush(stdout);
}

/// False if a scene was refused.
bool run(const Options& o)
{
    const host::Device device = host::find_device(o.device);
    Contender product = make_contender(device, o, host::embedded_kernel);
    Contender pool = make_contender(device, o, pool_kernels(o.lanes));
    fmt::print("{}, {}, {} sample(s), packets of {}, median of {} rounds, ms of the processor\n\n",
               host::describe(device.info), o.size, o.samples, o.lanes, o.rounds);
    fmt::print("| scene | rays | % by scalar search | product | pool | product / pool | pixels > 1/255 | > 2e-6 | RMSE "
               "| s to compile: product | pool |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
    bool all = true;
    for (const std::string& file : o.scenes) {
        try {
            measure(file, product, pool, o);
        } catch (const host::Failure& e) {
            fmt::print(stderr, "pool_frames: {}: {}\n", file, e.what());
            all = false;
        }
    }
    return all;
}

} // namespace
} // namespace clucida::bench

int main(int argc, char** argv)
{
    clucida::bench::Options o;
    CLI::App app("How long frames take by packets of rays");
    app.add_option("scenes", o.scenes, "scene files")->required();
    app.add_option("-s,--size", o.size, "of the picture")->capture_default_str();
    app.add_option("--samples", o.samples, "of each pixel")->capture_default_str();
    app.add_option("--rounds", o.rounds, "of which the median counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--lanes", o.lanes, "rays of a packet")->check(CLI::IsMember({8, 16}))->capture_default_str();
    app.add_option("--device", o.device, "as for `clucida render`");
    app.add_flag("--as-original", o.as_original, "as for `clucida render`");
    CLI11_PARSE(app, argc, argv);
    try {
        return clucida::bench::run(o) ? EXIT_SUCCESS : EXIT_FAILURE;
    } catch (const std::exception& e) {
        fmt::print(stderr, "pool_frames: {}\n", e.what());
        return EXIT_FAILURE;
    }
}
