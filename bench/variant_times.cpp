/// What the variants of the kernels cost: variant_times scenes/*.clu -s 320x180 prints a table of a frame's time in
/// each.
///
/// The variants take turns, and each is rendered once before, so that compilation counts for nothing. On a machine that
/// others use too the processor's time, of all threads, says more than the clock: --clock asks for that.

#include "bench/median.h"
#include "bench/variants.h"
#include "host/arguments.h"
#include "host/devices.h"
#include "host/errors.h"
#include "host/renderer.h"
#include "host/scene_source.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <filesystem>

namespace clucida::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    std::string size = "320x180", device;
    unsigned samples = 1, rounds = 11;
    bool clock = false;
};

/// A variant in one precision, with a renderer of its own that keeps its program.
struct Contender {
    std::string name;
    host::RenderSettings settings;
    host::Renderer renderer;
    std::vector<double> seconds;
    std::uint64_t faults = 0;
};

std::vector<Contender> make_contenders(const host::Device& device, const Options& o)
{
    std::vector<Contender> out;
    const auto add = [&](const std::string& variant, host::Precision precision, const std::string& name) {
        host::RenderSettings settings;
        settings.picture = host::parse_picture_size(o.size);
        settings.samples = o.samples;
        settings.tile = settings.picture; // one launch, and no time spent on choosing
        settings.precision = precision;
        settings.kernels = variant_kernels(variant);
        out.push_back({name, settings, host::make_renderer(device), {}, 0});
    };
    for (const std::string& name : variant_names()) add(name, host::Precision::single, name);
    if (device.info.has_double) add("full", host::Precision::twofold, "full, double");
    return out;
}

void render(Contender& c, const scene::Compiled& compiled, bool clock)
{
    const std::clock_t before = std::clock();
    const host::Frame frame = host::render_frame(c.renderer, compiled, c.settings);
    const double spent = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
    c.seconds.push_back(clock ? frame.timings.trace : spent);
    c.faults = frame.statistics.parity;
}

/// The median of what each round gives: a round is short, so what slows the machine slows all of it.
double ratio(const Contender& c, const Contender& to)
{
    std::vector<double> ratios;
    for (std::size_t i = 0; i < c.seconds.size(); ++i) ratios.push_back(c.seconds[i] / to.seconds[i]);
    return median(ratios);
}

void measure(const std::string& file, std::vector<Contender>& contenders, const Options& o)
{
    const host::SceneSource source = host::load_scene({file, "", "", false});
    const host::Shape size = contenders.front().settings.picture;
    const scene::Compiled compiled = host::compile_scene(source, {size.width, size.height, o.samples, {}, {}, {}});
    for (Contender& c : contenders) {
        render(c, compiled, o.clock);
        c.seconds.clear();
    }
    for (unsigned round = 0; round < o.rounds; ++round)
        for (Contender& c : contenders) render(c, compiled, o.clock);

    fmt::print("| {} |", source.name);
    for (const Contender& c : contenders) fmt::print(" {:.1f} |", 1e3 * median(c.seconds));
    for (std::size_t i = 1; i < contenders.size(); ++i)
        fmt::print(" {:.2f} |", ratio(contenders[i], contenders.front()));
    for (const Contender& c : contenders) fmt::print(" {} |", c.faults);
    fmt::print("\n");
    std::fflush(stdout);
}

void run(const Options& o)
{
    const host::Device device = host::find_device(o.device);
    std::vector<Contender> contenders = make_contenders(device, o);
    fmt::print("{}, {}, {} sample(s), median of {} rounds, ms of {}; ratios to naive; parity faults\n\n",
               host::describe(device.info), o.size, o.samples, o.rounds, o.clock ? "the clock" : "the processor");
    fmt::print("| scene |");
    for (const Contender& c : contenders) fmt::print(" {} |", c.name);
    for (std::size_t i = 1; i < contenders.size(); ++i) fmt::print(" {} / naive |", contenders[i].name);
    for (const Contender& c : contenders) fmt::print(" {}: faults |", c.name);
    fmt::print("\n|---|");
    for (std::size_t i = 1; i < 3 * contenders.size(); ++i) fmt::print("---|");
    fmt::print("\n");
    for (const std::string& file : o.scenes) measure(file, contenders, o);
}

} // namespace
} // namespace clucida::bench

int main(int argc, char** argv)
{
    clucida::bench::Options o;
    CLI::App app("What the variants of the kernels cost");
    app.add_option("scenes", o.scenes, "scene files")->required();
    app.add_option("-s,--size", o.size, "of the picture")->capture_default_str();
    app.add_option("--samples", o.samples, "of each pixel")->capture_default_str();
    app.add_option("--rounds", o.rounds, "of which the median counts")->capture_default_str();
    app.add_option("--device", o.device, "as for `clucida render`");
    app.add_flag("--clock", o.clock, "measure by the clock, as on a GPU; else the processor's time");
    CLI11_PARSE(app, argc, argv);
    try {
        clucida::bench::run(o);
    } catch (const std::exception& e) {
        fmt::print(stderr, "variant_times: {}\n", e.what());
        return EXIT_FAILURE;
    }
}
