/// What many objects cost: many_objects FOLDER/spheres*.clu prints a table, of the fields of spheres of
/// bench/corpus.py.
///
/// One thread, the core as C. Each little tile is rendered over and over: once as it comes, with nothing of its own in
/// the caches, and then with all of it there. The difference is what memory costs.

#include "bench/median.h"
#include "host/arguments.h"
#include "host/scene_source.h"
#include "kernels/native_api.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdlib>
#include <ctime>
#include <stdexcept>

extern "C" unsigned long nodes_opened;

namespace clucida::bench {
namespace {

constexpr std::uint32_t tile = 2; ///< pixels across: what its rays need fits a small cache

struct Options {
    std::vector<std::string> scenes;
    std::string size = "320x180";
    unsigned rounds = 5;
};

/// Seconds of the thread.
double now()
{
    timespec t{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// Has the core the features that the scene needs, and room enough?
void check(const scene::Needs& needs)
{
    const std::uint32_t features =
        scene::feature_sphere | scene::feature_transparent | scene::feature_light_paper | scene::feature_sky_rgb;
    if ((needs.features & ~features) != 0 || needs.groups > 1 || needs.walk > 128)
        throw std::runtime_error("this is no field of spheres as bench/corpus.py makes them");
}

struct Picture {
    double cold = 0, warm = 0; ///< seconds
    unsigned long nodes = 0;
    std::array<u32, STAT_COUNT> stats{};
};

Picture render(const NativeScene& scene, host::Shape size)
{
    Picture p;
    std::array<float, std::size_t{4} * tile * tile> rgba{};
    std::array<u32, STAT_COUNT> again{};
    for (std::uint32_t y = 0; y + tile <= size.height; y += tile) {
        for (std::uint32_t x = 0; x + tile <= size.width; x += tile) {
            const unsigned long before = nodes_opened;
            const double start = now();
            native_render_f(&scene, x, y, tile, tile, 0, 1, rgba.data(), p.stats.data());
            const double middle = now();
            p.nodes += nodes_opened - before;
            native_render_f(&scene, x, y, tile, tile, 0, 1, rgba.data(), again.data());
            p.warm += now() - middle;
            p.cold += middle - start;
        }
    }
    return p;
}

void measure(const std::string& file, const Options& o)
{
    const host::Shape size = host::parse_picture_size(o.size);
    const scene::Compiled compiled =
        host::compile_scene(host::load_scene({file, "", "", false}), {size.width, size.height, 1, {}, {}, {}});
    check(compiled.needs);
    NativeScene scene{};
    for (std::size_t i = 0; i < BUFFER_COUNT; i++) scene.buffers[i] = compiled.buffers.bytes[i].data();
    std::vector<double> cold, warm;
    Picture p;
    for (unsigned round = 0; round < o.rounds; round++) {
        p = render(scene, size);
        cold.push_back(p.cold);
        warm.push_back(p.warm);
    }
    const double pixels = static_cast<double>(size.width) * size.height;
    const double rays = p.stats[STAT_RAYS] + p.stats[STAT_SHADOW];
    fmt::print("| {} | {:.1f} | {:.2f} | {:.2f} | {:.1f} | {:.2f} | {:.2f} | {:.0f} | {} |\n",
               scene::object_count(compiled.buffers), static_cast<double>(scene::byte_count(compiled.buffers)) * 1e-6,
               rays / pixels, p.stats[STAT_TESTS] / rays, static_cast<double>(p.nodes) / rays,
               1e6 * median(cold) / pixels, 1e6 * median(warm) / pixels, 1e9 * median(cold) / rays,
               p.stats[STAT_PARITY]);
    std::fflush(stdout);
}

} // namespace
} // namespace clucida::bench

int main(int argc, char** argv)
{
    clucida::bench::Options o;
    CLI::App app("What many objects cost");
    app.add_option("scenes", o.scenes, "fields of spheres")->required();
    app.add_option("-s,--size", o.size, "of the picture")->capture_default_str();
    app.add_option("--rounds", o.rounds, "of which the median counts")->capture_default_str()->check(CLI::Range(1, 99));
    CLI11_PARSE(app, argc, argv);
    try {
        fmt::print(
            "| objects | MB | rays a pixel | objects tested a ray | nodes a ray | us a pixel | caches warm | ns a ray "
            "| parity faults |\n|---:|---:|---:|---:|---:|---:|---:|---:|---:|\n");
        for (const std::string& file : o.scenes) clucida::bench::measure(file, o);
    } catch (const std::exception& e) {
        fmt::print(stderr, "many_objects: {}\n", e.what());
        return EXIT_FAILURE;
    }
}
