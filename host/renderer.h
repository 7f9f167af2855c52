/// A compiled scene becomes a picture on a device.
#pragma once

#include "host/canvas.h"
#include "host/devices.h"
#include "host/kernel_source.h"
#include "host/picture.h"
#include "host/program.h"
#include "host/statistics.h"
#include "host/tiling.h"
#include "scene/compile.h"

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>

namespace clucida::host {

/// The two kernels that render: a work-item for each pixel, which traces one ray at a time; or one for each block of
/// pixels, which traces packets of rays side by side in the registers of a CPU with wide vectors.
enum class KernelShape { pixels, packets };

/// The faster one on the device for a scene of so many objects: in a large tree the rays of a packet part soon.
KernelShape kernel_shape(const DeviceInfo& device, std::size_t objects);

struct RenderSettings {
    Shape picture;        ///< as the scene was compiled for
    unsigned samples = 1; ///< of a pixel, likewise
    Precision precision = Precision::single;
    KernelCache cache = KernelCache::automatic;
    std::optional<KernelShape> kernel;   ///< else the one that is made for the device
    std::optional<Shape> group;          ///< work-items of a work-group, of the kernel of pixels; else chosen
    std::optional<Shape> tile;           ///< else chosen by measuring; rounded up to whole work-groups
    double launch_seconds = 0.25;        ///< what a launch may take, when the tile is chosen
    bool measure = true;                 ///< how long a sample takes, unless that is known from a frame before
    unsigned in_flight = 3;              ///< launches given to the device before the first is waited for
    FileTexts kernels = embedded_kernel; ///< the kernels' text
};

struct Timings {
    double build = 0;         ///< compilation, or reading the cache, s
    double first_enqueue = 0; ///< an empty launch: code generation where the implementation puts it off until then, s
    double upload = 0;        ///< the scene to the device, s
    double trace = 0;         ///< all launches and their results' way back, s
    double trace_cpu = 0;     ///< the time that this process's threads computed meanwhile, s
    double kernels = 0;       ///< that the device says its kernels ran; 0 unless profiled, s
    double rows = 0;          ///< what RenderHooks::rows took when all launches were done, s
};

struct Frame {
    Picture picture; ///< without pixels if RenderHooks::rows took them
    Statistics statistics;
    Timings timings;
    std::string device;
    KernelShape kernel = KernelShape::pixels;
    Shape group; ///< work-items of a work-group, on the first device
    Shape tile;  ///< the largest region of a launch
    std::size_t launches = 0;
    unsigned retries = 0;           ///< renderings that a capacity proved too small for
    scene::Needs needs;             ///< as they sufficed
    std::vector<std::string> notes; ///< something worth telling that is no error
};

/// Each may be empty.
struct RenderHooks {
    std::function<void(double fraction)> progress = {}; ///< after each launch, 0..1
    std::function<bool()> cancelled = {};               ///< asked between launches
    /// Takes the picture in bands, so that memory need not hold all of it. From 0 again if a capacity overflowed and
    /// the frame is rendered once more.
    TakeRows rows = {};
};

/// Whether the device keeps the times of what it does (Timings::kernels).
enum class Profiling : bool { no, yes };

/// What stays the same from frame to frame: the device, its queue, the program of the last needs.
struct Renderer {
    Device device;
    cl::Context context;
    cl::CommandQueue queue;
    Program program;
    scene::Needs needs; ///< of the program; meaningless while it is empty
    Precision precision = Precision::single;
    KernelShape kernel = KernelShape::pixels;
    Profiling profiling = Profiling::no;
    std::optional<Shape> group;           ///< of the kernel of pixels, as measured (launch_shape.h)
    std::optional<double> sample_seconds; ///< of a pixel, as last measured
    std::string failure = {};             ///< why it is not used any more; empty while it works
    unsigned builds = 0;                  ///< how often a program was built, or read from the cache
};

/// @throws Failure
Renderer make_renderer(const Device& device, Profiling profiling = Profiling::no);

/// One for each. @throws Failure
std::vector<Renderer> make_renderers(std::span<const Device> devices);

/// The scene on the device, in the order of LayoutBuffer.
using DeviceBuffers = std::array<cl::Buffer, BUFFER_COUNT>;

/// @throws Failure if the device cannot hold it, cl::Error
DeviceBuffers upload(const Renderer& renderer, const scene::Buffers& buffers);

/// The shape of the kernel's work-groups: the wanted one, else the renderer's if the kernel can take as many, else the
/// usual one. @throws Failure if the wanted one is more than it can
Shape group_of(const Renderer& renderer, const cl::Kernel& kernel, std::optional<Shape> wanted);

/// Launches a kernel that traces with an item for each of `count` things, and some that are to spare: the work-group is
/// not left to the implementation. PoCL keeps what all items of a group hold on one stack, which a group of thousands
/// overflows. @throws cl::Error
void enqueue_each(const Renderer& renderer, const cl::Kernel& kernel, std::size_t count);

/// Doubles the capacities that a frame overflowed. False if it overflowed none, or none can be more.
bool enlarge(scene::Needs& needs, const Statistics& statistics);

/// Renders one frame; the picture is the same to the byte whatever the tiles, and whoever of the team traces which,
/// provided that their arithmetic agrees: a note tells where a look at a few tiles says that it does not. A device that
/// fails leaves its part to the others, with a note, and is not used again. A capacity that proves too small is
/// doubled, up to 512, and the frame rendered again.
/// @throws Failure if all devices fail or cannot hold the scene, Interrupted if hooks.cancelled says so
Frame render_frame(std::span<Renderer> team, const scene::Compiled& compiled, const RenderSettings& settings,
                   const RenderHooks& hooks = {});
inline Frame render_frame(Renderer& renderer, const scene::Compiled& compiled, const RenderSettings& settings,
                          const RenderHooks& hooks = {})
{
    return render_frame(std::span(&renderer, 1), compiled, settings, hooks);
}

/// Renders one frame of several, with a program that serves all so far: needs grows to what they take together, a
/// capacity that overflowed included; devices are measured for the first.
Frame render_next(std::span<Renderer> team, scene::Compiled compiled, RenderSettings& settings, scene::Needs& needs,
                  const RenderHooks& hooks);

} // namespace clucida::host
