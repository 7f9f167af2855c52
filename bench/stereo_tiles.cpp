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
#include "host/renderer.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstring>
#include <ctime>

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
    std::vector<host::DeviceBuffers> buffers; ///< of each eye; kernels do not keep them
    std::vector<cl::Kernel> kernels;          ///< with these set
    cl::Buffer tile, stats;
    host::Shape picture, block, items;
    std::size_t shared = 0, bytes = 0; ///< of an eye's buffers: bytes that both have in common, and all
};

bool same(const scene::Bytes& a, const scene::Bytes& b)
{
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size()) == 0);
}

Eyes prepare(const std::string& file, const host::Device& device, const Options& o)
{
    Eyes eyes;
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
    const bool packets = done.kernel == host::KernelShape::packets;
    eyes.block = packets ? host::Shape{32, 32} : host::Shape{1, 1};
    eyes.items = packets ? host::Shape{1, 1} : host::Shape{8, 8};
    auto& buffers = eyes.buffers;
    for (const scene::Compiled& eye : frame.eyes) {
        buffers.push_back(host::upload(eyes.renderer, eye.buffers));
        cl::Kernel kernel(eyes.renderer.program.handle, "render");
        for (cl_uint i = 0; i < BUFFER_COUNT; ++i) {
            const bool shared = same(eye.buffers.bytes[i], frame.eyes[0].buffers.bytes[i]);
            if (buffers.size() == 2) {
                eyes.bytes += eye.buffers.bytes[i].size();
                if (shared) eyes.shared += eye.buffers.bytes[i].size();
            }
            kernel.setArg(i, shared ? buffers[0][i] : buffers.back()[i]);
        }
        eyes.kernels.push_back(std::move(kernel));
    }
    eyes.tile = cl::Buffer(eyes.renderer.context, CL_MEM_READ_WRITE,
                           host::area(host::round_up(eyes.picture, {32, 32})) * 4 * sizeof(float));
    const std::vector<cl_uint> none(std::size_t{STAT_SLOTS} * STAT_COUNT);
    eyes.stats = cl::Buffer(eyes.renderer.context, CL_MEM_READ_WRITE, none.size() * sizeof(cl_uint));
    eyes.renderer.queue.enqueueWriteBuffer(eyes.stats, CL_TRUE, 0, none.size() * sizeof(cl_uint), none.data());
    return eyes;
}

void launch(Eyes& eyes, cl::Kernel& kernel, host::Shape tile, unsigned x0, unsigned y0)
{
    cl_uint argument = BUFFER_COUNT;
    for (const cl_uint value : {x0, y0, 0U, 1U}) kernel.setArg(argument++, value);
    kernel.setArg(argument++, eyes.tile);
    kernel.setArg(argument, eyes.stats);
    eyes.renderer.queue.enqueueNDRangeKernel(
        kernel, cl::NullRange, cl::NDRange(tile.width / eyes.block.width, tile.height / eyes.block.height),
        cl::NDRange(eyes.items.width, eyes.items.height));
}

/// Seconds of the processor for a pair.
double render_pair(Eyes& eyes, host::Shape tile, bool in_turns)
{
    const std::clock_t begin = std::clock();
    const auto each_tile = [&](const std::function<void(unsigned, unsigned)>& work) {
        for (unsigned y = 0; y < eyes.picture.height; y += tile.height)
            for (unsigned x = 0; x < eyes.picture.width; x += tile.width) work(x, y);
    };
    if (in_turns) {
        each_tile([&](unsigned x, unsigned y) {
            for (cl::Kernel& kernel : eyes.kernels) launch(eyes, kernel, tile, x, y);
        });
    } else {
        for (cl::Kernel& kernel : eyes.kernels)
            each_tile([&](unsigned x, unsigned y) { launch(eyes, kernel, tile, x, y); });
    }
    eyes.renderer.queue.finish();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void measure(const std::string& file, const host::Device& device, const Options& o)
{
    Eyes eyes = prepare(file, device, o);
    for (const std::string& text : o.tiles) {
        const host::Shape group{eyes.items.width * eyes.block.width, eyes.items.height * eyes.block.height};
        const host::Shape tile = host::round_up(host::parse_size(text, "the tile's size"), group);
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
