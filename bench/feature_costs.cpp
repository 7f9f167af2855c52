/// What a kernel variant would cost with features that its scene does not need: feature_costs scenes/*.clu prints a
/// table of each scene with its own features alone, with each of the others besides, and with all of them.
///
/// The variants take turns. Time is the processor's, of all threads: POCL_MAX_PTHREAD_COUNT=1 makes PoCL take one.

#include "bench/median.h"
#include "host/arguments.h"
#include "host/devices.h"
#include "host/errors.h"
#include "host/renderer.h"
#include "host/scene_source.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdlib>

namespace clucida::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    std::string size = "320x180", device;
    unsigned rounds = 7;
    bool brief = false;
};

struct Contender {
    std::string name;
    scene::Compiled compiled;
    host::Renderer renderer;
    host::RenderSettings settings;
    double compilation = 0; ///< s, with no cache
    std::vector<double> seconds;
};

void render(Contender& c)
{
    const host::Frame frame = host::render_frame(c.renderer, c.compiled, c.settings);
    c.compilation += frame.timings.build + frame.timings.first_enqueue;
    c.compiled.needs = frame.needs;
    c.seconds.push_back(frame.timings.trace_cpu);
}

/// What imitates an original program draws another picture.
constexpr std::uint32_t imitations = scene::feature_as_gun | scene::feature_as_rayt;

std::vector<Contender> make_contenders(const host::SceneSource& source, const host::Device& device, const Options& o)
{
    std::vector<Contender> out;
    host::RenderSettings settings;
    settings.picture = host::parse_picture_size(o.size);
    settings.tile = settings.picture; // one launch, and no time spent on choosing
    settings.cache = host::KernelCache::off;
    const auto add = [&](const std::string& name, std::uint32_t features) {
        Contender c{name,
                    host::compile_scene(source, {settings.picture.width, settings.picture.height, 1, {}, {}, {}}),
                    host::make_renderer(device),
                    settings,
                    0,
                    {}};
        c.compiled.needs.features |= features;
        out.push_back(std::move(c));
    };
    add("its own", 0);
    const std::uint32_t own = out.front().compiled.needs.features;
    std::uint32_t all = 0;
    for (const scene::FeatureName& f : scene::feature_names()) {
        if ((own | imitations) & f.feature) continue;
        all |= f.feature;
        if (!o.brief) add(f.name, f.feature);
    }
    add("all", all);
    return out;
}

void measure(const std::string& file, const host::Device& device, const Options& o)
{
    const host::SceneSource source = host::load_scene({file, "", "", false});
    std::vector<Contender> contenders = make_contenders(source, device, o);
    for (Contender& c : contenders) {
        render(c);
        const double compilation = c.compilation;
        render(c); // again, for the first may have been begun anew for want of capacity
        c.compilation = compilation;
        c.seconds.clear();
    }
    for (unsigned round = 0; round < o.rounds; ++round)
        for (Contender& c : contenders) render(c);
    const Contender& own = contenders.front();
    for (const Contender& c : contenders) {
        std::vector<double> ratios;
        for (std::size_t i = 0; i < c.seconds.size(); ++i) ratios.push_back(c.seconds[i] / own.seconds[i]);
        fmt::print("| {} | {} | {:.1f} | {:.2f} | {:.2f} | {:.2f} |\n", source.name, c.name, 1e3 * median(c.seconds),
                   median(ratios), c.compilation, c.compilation / own.compilation);
    }
    std::fflush(stdout);
}

void run(const Options& o)
{
    const host::Device device = host::find_device(o.device);
    fmt::print("{}, {}, median of {} rounds, ms of the processor\n\n"
               "| scene | features besides its own | trace, ms | ratio | to compile, s | ratio |\n"
               "|---|---|---:|---:|---:|---:|\n",
               host::describe(device.info), o.size, o.rounds);
    for (const std::string& file : o.scenes) measure(file, device, o);
}

} // namespace
} // namespace clucida::bench

int main(int argc, char** argv)
{
    clucida::bench::Options o;
    CLI::App app("What kernel variants cost with features that their scenes do not need");
    app.add_option("scenes", o.scenes, "scene files")->required();
    app.add_option("-s,--size", o.size, "of the picture")->capture_default_str();
    app.add_option("--rounds", o.rounds, "of which the median counts")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--device", o.device, "as for `clucida render`");
    app.add_flag("--brief", o.brief, "only a scene's own features, and all");
    CLI11_PARSE(app, argc, argv);
    try {
        ::setenv("POCL_KERNEL_CACHE", "0", 1); // what is in PoCL's own cache is not compiled
        clucida::bench::run(o);
        return EXIT_SUCCESS;
    } catch (const std::exception& e) {
        fmt::print(stderr, "feature_costs: {}\n", e.what());
        return EXIT_FAILURE;
    }
}
