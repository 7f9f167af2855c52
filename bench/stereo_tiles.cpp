/// Whether two eyes' pictures share work: stereo_tiles scenes/*.clu -s 640x360 prints how long a pair takes picture
/// after picture, and with the eyes' tiles in turns, so that what one eye's rays have fetched may lie in the caches for
/// the other's. Buffers that are the same for both eyes (photographs, planes' normals do not move with the eye) are
/// one.
///
/// Time is the processor's, of all threads: POCL_MAX_PTHREAD_COUNT=1 makes PoCL take one.

#include "bench/median.h"
#include "host/arguments.h"
#include "host/devices.h"
#include "host/errors.h"
#include "host/motion.h"
#include "host/opencl_tracer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <array>
#include <cstring>
#include <ctime>
#include <memory>

namespace clucida::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    std::string size = "640x360", device;
    std::vector<std::string> tiles = {"32x32", "128x128", "320x180"};
    unsigned rounds = 7;
};

struct Eyes {
    host::Renderer renderer;
    std::array<host::DeviceBuffers, 2> buffers;         ///< of each eye; kernels do not keep them
    std::vector<std::unique_ptr<host::Tracer>> tracers; ///< with these
    host::Shape picture;
    std::size_t shared = 0, bytes = 0; ///< of an eye's buffers: bytes that both have in common, and all
};

bool same(const scene::Bytes& a, const scene::Bytes& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

/// The tracers have the renderer and the buffers of just these eyes.
void prepare(Eyes& eyes, const std::string& file, const host::Device& device, const Options& o)
{
    eyes.picture = host::parse_picture_size(o.size);
    host::SceneOptions options;
    options.file = file;
    const host::Motion motion(host::load_scene(options), options,
                              {eyes.picture.width, eyes.picture.height, 1, {}, {}, {}, {}},
                              {host::StereoLayout::side_by_side, {}, {}});
    host::CompiledFrame frame = motion.compile(1);
    const scene::Needs needs = unite(frame.eyes[0].needs, frame.eyes[1].needs);
    eyes.renderer = host::make_renderer(device);
    host::RenderSettings settings;
    settings.picture = eyes.picture;
    host::Frame done;
    for (scene::Compiled& eye : frame.eyes) { // builds the program that suffices for both
        eye.needs = done.picture.width ? done.needs : needs;
        done = host::render_frame(eyes.renderer, eye, settings);
    }
    for (std::size_t side = 0; side < 2; ++side) {
        const scene::Compiled& eye = frame.eyes[side];
        host::DeviceBuffers& own = eyes.buffers[side] = host::upload(eyes.renderer, eye.buffers);
        for (std::size_t i = 0; side > 0 && i < BUFFER_COUNT; ++i) {
            eyes.bytes += eye.buffers.bytes[i].size();
            if (!same(eye.buffers.bytes[i], frame.eyes[0].buffers.bytes[i])) continue;
            eyes.shared += eye.buffers.bytes[i].size();
            own[i] = eyes.buffers[0][i];
        }
        eyes.tracers.push_back(host::make_opencl_tracer(eyes.renderer, own, settings));
    }
}

/// Seconds of the processor for a pair.
double render_pair(const Eyes& eyes, host::Shape tile, bool in_turns)
{
    const std::array lanes = {eyes.tracers[0]->make_lane(area(tile)), eyes.tracers[1]->make_lane(area(tile))};
    const auto trace = [&](host::Lane& lane, unsigned x, unsigned y) {
        lane.launch({x, y, tile}, 0, 1, true);
        lane.wait();
    };
    const std::clock_t begin = std::clock();
    const auto each_tile = [&](const std::function<void(unsigned, unsigned)>& work) {
        for (unsigned y = 0; y < eyes.picture.height; y += tile.height)
            for (unsigned x = 0; x < eyes.picture.width; x += tile.width) work(x, y);
    };
    if (in_turns) {
        each_tile([&](unsigned x, unsigned y) {
            for (const auto& lane : lanes) trace(*lane, x, y);
        });
    } else {
        for (const auto& lane : lanes) each_tile([&](unsigned x, unsigned y) { trace(*lane, x, y); });
    }
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void measure(const std::string& file, const host::Device& device, const Options& o)
{
    Eyes eyes;
    prepare(eyes, file, device, o);
    for (const std::string& text : o.tiles) {
        const host::Shape tile = host::round_up(host::parse_size(text, "the tile's size"), eyes.tracers[0]->grain());
        std::vector<double> apart, in_turns;
        render_pair(eyes, tile, false);
        for (unsigned round = 0; round < o.rounds; ++round) {
            apart.push_back(render_pair(eyes, tile, false));
            in_turns.push_back(render_pair(eyes, tile, true));
        }
        fmt::print("| {} | {:.0f} of {:.0f} | {}x{} | {:.1f} | {:.1f} | {:.3f} |\n", file.substr(file.rfind('/') + 1),
                   static_cast<double>(eyes.shared) / 1024, static_cast<double>(eyes.bytes) / 1024, tile.width,
                   tile.height, 1e3 * median(apart), 1e3 * median(in_turns), median(in_turns) / median(apart));
    }
}

int run(int argc, char** argv)
{
    Options o;
    CLI::App app("Whether two eyes' pictures share work");
    app.add_option("scenes", o.scenes)->required();
    app.add_option("-s,--size", o.size, "of an eye's picture")->capture_default_str();
    app.add_option("--tiles", o.tiles, "shapes of tiles")->delimiter(',');
    app.add_option("--rounds", o.rounds)->capture_default_str();
    app.add_option("--device", o.device);
    CLI11_PARSE(app, argc, argv);
    try {
        const host::Device device = host::find_device(host::device_selector(o.device));
        fmt::print("{}, {} an eye, median of {} rounds\n\n", describe(device.info), o.size, o.rounds);
        fmt::print(
            "| scene | KiB that both eyes share | tile | picture after picture, ms | tiles in turns, ms | ratio |\n"
            "|---|---:|---:|---:|---:|---:|\n");
        for (const std::string& scene : o.scenes) measure(scene, device, o);
    } catch (const std::exception& e) {
        fmt::print(stderr, "stereo_tiles: error: {}\n", e.what());
        return 1;
    }
    return 0;
}

} // namespace
} // namespace clucida::bench

int main(int argc, char** argv)
{
    return clucida::bench::run(argc, argv);
}
