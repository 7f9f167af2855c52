#include "host/launches.h"

#include "host/errors.h"
#include "host/stopwatch.h"

#include <array>

namespace clucida::host {
namespace {

constexpr std::size_t stats_count = std::size_t{STAT_SLOTS} * STAT_COUNT;
constexpr std::size_t pixel_bytes = 4 * sizeof(float);

/// One of the launches in flight, with memory of its own on both sides.
struct Lane {
    cl::Buffer tile, stats;
    std::vector<float> tile_copy;
    std::vector<std::uint32_t> stats_copy;
    std::vector<std::uint32_t> no_stats; ///< what a launch's counters begin as
    cl::Event traced;                    ///< of the kernel
    cl::Event done;                      ///< of the results' way back
    std::size_t index = 0;
    unsigned samples_begin = 0, samples_end = 0;
    bool busy = false;     ///< a launch is in flight
    bool has_tile = false; ///< a tile is begun, whose next samples are to be launched
};

Lane make_lane(const cl::Context& context, Shape tile)
{
    Lane lane;
    lane.tile = cl::Buffer(context, CL_MEM_READ_WRITE, area(tile) * pixel_bytes);
    lane.stats = cl::Buffer(context, CL_MEM_READ_WRITE, stats_count * sizeof(cl_uint));
    lane.tile_copy.resize(area(tile) * 4);
    lane.stats_copy.resize(stats_count);
    lane.no_stats.resize(stats_count);
    return lane;
}

void enqueue(Tracer& t, Lane& lane, Shape tile, unsigned x0, unsigned y0)
{
    // Not filled: Oclgrind 21.10 takes no note of fills and would call every counter uninitialized.
    t.queue.enqueueWriteBuffer(lane.stats, CL_FALSE, 0, stats_count * sizeof(cl_uint), lane.no_stats.data());
    cl_uint argument = BUFFER_COUNT;
    t.kernel.setArg(argument++, cl_uint{x0});
    t.kernel.setArg(argument++, cl_uint{y0});
    t.kernel.setArg(argument++, cl_uint{lane.samples_begin});
    t.kernel.setArg(argument++, cl_uint{lane.samples_end});
    t.kernel.setArg(argument++, lane.tile);
    t.kernel.setArg(argument, lane.stats);
    t.queue.enqueueNDRangeKernel(t.kernel, cl::NullRange,
                                 cl::NDRange(tile.width / t.block.width, tile.height / t.block.height),
                                 cl::NDRange(t.items.width, t.items.height), nullptr, &lane.traced);
}

void enqueue_results(Tracer& t, Lane& lane, bool with_tile)
{
    if (with_tile)
        t.queue.enqueueReadBuffer(lane.tile, CL_FALSE, 0, lane.tile_copy.size() * sizeof(float), lane.tile_copy.data());
    t.queue.enqueueReadBuffer(lane.stats, CL_FALSE, 0, stats_count * sizeof(cl_uint), lane.stats_copy.data(), nullptr,
                              &lane.done);
    t.queue.flush();
    lane.busy = true;
}

/// A tile into rows of the picture, which begin with the tile's first.
void copy_tile(const Lane& lane, const Tiling& tiling, unsigned samples, float* rows)
{
    const Shape part = tiling.visible(lane.index);
    for (unsigned j = 0; j < part.height; ++j) {
        const float* from = lane.tile_copy.data() + std::size_t{4} * tiling.tile.width * j;
        float* to = rows + 3 * (std::size_t{j} * tiling.picture.width + tiling.x0(lane.index));
        for (unsigned i = 0; i < part.width; ++i, from += 4, to += 3)
            for (int channel = 0; channel < 3; ++channel) to[channel] = from[channel] / static_cast<float>(samples);
    }
}

/// Where tiles go when they are finished, which they are in order: the whole picture, or one row of tiles at a time.
class Canvas {
public:
    Canvas(const Tiling& tiling, Picture& picture, const RenderHooks& hooks)
        : tiling_(tiling), picture_(picture), hooks_(hooks)
    {
        if (hooks.rows) band_.resize(row_floats() * std::min(tiling.tile.height, tiling.picture.height));
    }
    void add(const Lane& lane, unsigned samples)
    {
        const std::size_t y = tiling_.y0(lane.index);
        copy_tile(lane, tiling_, samples, hooks_.rows ? band_.data() : picture_.rgb.data() + y * row_floats());
        last_ = lane.index;
        full_ = (last_ + 1) % tiling_.columns() == 0;
    }
    /// Gives the band away if it is complete. Apart from add, so that the device has work meanwhile.
    void hand_over()
    {
        if (!full_) return;
        const std::size_t floats = row_floats() * tiling_.visible(last_).height;
        if (hooks_.rows) hooks_.rows(tiling_.y0(last_), std::span(band_).first(floats));
        full_ = false;
    }

private:
    std::size_t row_floats() const { return std::size_t{3} * tiling_.picture.width; }

    const Tiling& tiling_;
    Picture& picture_;
    const RenderHooks& hooks_;
    std::vector<float> band_;
    std::size_t last_ = 0; ///< tile that was added
    bool full_ = false;    ///< it completed a band
};

double seconds_of(const cl::Event& event)
{
    constexpr double nanosecond = 1e-9;
    const auto begin = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    return nanosecond * static_cast<double>(event.getProfilingInfo<CL_PROFILING_COMMAND_END>() - begin);
}

/// Waits for the lane's launch and takes its results.
void collect(const Tracer& tracer, Lane& lane, unsigned samples, Frame& frame, Canvas& canvas)
{
    lane.done.wait();
    lane.busy = false;
    if (tracer.profiling == Profiling::yes) frame.timings.kernels += seconds_of(lane.traced);
    add_rows(frame.statistics, lane.stats_copy);
    lane.has_tile = lane.samples_end < samples;
    if (!lane.has_tile) canvas.add(lane, samples);
}

/// Lanes write into memory of the host, which must outlive what is in flight.
struct FinishBeforeLeaving {
    const cl::CommandQueue& queue;
    ~FinishBeforeLeaving() { ::clFinish(queue()); }
};

} // namespace

void warm_up(Tracer& tracer)
{
    Lane lane = make_lane(tracer.context, tracer.group());
    enqueue(tracer, lane, tracer.group(), 0, 0);
    tracer.queue.finish();
}

double measure_sample(Tracer& tracer, Shape picture)
{
    const Shape tile = round_up({std::min(picture.width, 32u), std::min(picture.height, 32u)}, tracer.group());
    Lane lane = make_lane(tracer.context, tile);
    lane.samples_end = 1;
    double most = 0;
    // Low in the picture and in its middle, where skies are rare.
    constexpr std::array<std::array<unsigned, 2>, 3> quarters = {{{2, 2}, {1, 3}, {3, 3}}};
    for (const auto& [qx, qy] : quarters) {
        const Stopwatch watch;
        enqueue(tracer, lane, tile, picture.width / 4 * qx, picture.height / 4 * qy);
        tracer.queue.finish();
        most = std::max(most, watch.seconds());
    }
    return most / static_cast<double>(area(tile));
}

void trace_tiles(Tracer& tracer, const Tiling& tiling, const RenderSettings& settings, const RenderHooks& hooks,
                 Frame& frame)
{
    const std::size_t tiles = tiling.count();
    const std::size_t runs = (settings.samples + samples_per_launch - 1) / samples_per_launch;
    frame.launches = tiles * runs;

    Canvas canvas(tiling, frame.picture, hooks);
    std::vector<Lane> lanes;
    const FinishBeforeLeaving guard{tracer.queue};
    for (unsigned i = 0; i < std::min<std::size_t>(std::max(settings.in_flight, 1u), tiles); ++i)
        lanes.push_back(make_lane(tracer.context, tiling.tile));

    std::size_t next_tile = 0, collected = 0;
    for (std::size_t turn = 0; collected < frame.launches; ++turn) {
        Lane& lane = lanes[turn % lanes.size()];
        if (hooks.cancelled && hooks.cancelled()) throw Interrupted();
        if (lane.busy) {
            canvas.hand_over();
            collect(tracer, lane, settings.samples, frame, canvas);
            ++collected;
            if (hooks.progress) hooks.progress(static_cast<double>(collected) / static_cast<double>(frame.launches));
        }
        if (!lane.has_tile) {
            if (next_tile == tiles) continue;
            lane.index = next_tile++;
            lane.has_tile = true;
            lane.samples_end = 0;
        }
        lane.samples_begin = lane.samples_end;
        lane.samples_end = std::min(lane.samples_begin + samples_per_launch, settings.samples);
        enqueue(tracer, lane, tiling.tile, tiling.x0(lane.index), tiling.y0(lane.index));
        enqueue_results(tracer, lane, lane.samples_end == settings.samples);
    }
    const Stopwatch rows;
    canvas.hand_over();
    frame.timings.rows = rows.seconds();
}

} // namespace clucida::host
