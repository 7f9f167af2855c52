#include "host/trace.h"

#include "host/canvas.h"
#include "host/errors.h"
#include "host/launch_shape.h"
#include "host/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <exception>
#include <thread>

namespace clucida::host {
namespace {

constexpr Shape least_cell{32, 32};
constexpr std::size_t most_region_pixels = std::size_t{1} << 20;
constexpr std::size_t most_band_pixels = (std::size_t{64} << 20) / (3 * sizeof(float)); ///< 64 MiB

/// What the workers of a frame share.
struct Job {
    const RenderSettings& settings;
    const RenderHooks& hooks;
    Frame& frame;
    Regions regions;
    Canvas canvas;
    std::mutex mutex; ///< of what follows, of hooks and of frame
    std::uint64_t traced = 0;
    std::exception_ptr failure; ///< of a device, which others can make good
    std::exception_ptr end;     ///< of the frame

    /// What is no device's fault ends the work of all.
    void stop()
    {
        regions.stop();
        const std::lock_guard lock(mutex);
        if (!end) end = std::current_exception();
    }
    void hand_over()
    {
        try {
            canvas.hand_over();
        } catch (...) {
            stop();
        }
    }
    bool is_cancelled()
    {
        const std::lock_guard lock(mutex);
        return hooks.cancelled && hooks.cancelled();
    }
};

/// A lane and what it is at.
struct Task {
    std::unique_ptr<Lane> lane;
    std::optional<Region> region;
    unsigned samples_begin = 0, samples_end = 0;
    Statistics statistics; ///< of the region so far
    bool busy = false;
};

/// Takes what the lane has computed.
void collect(Job& job, Task& task)
{
    Lane& lane = *task.lane;
    lane.wait();
    task.busy = false;
    add_rows(task.statistics, lane.counters);
    const bool complete = task.samples_end == job.settings.samples;
    const bool counts = complete && job.regions.finish(*task.region);
    if (counts) job.canvas.add(*task.region, lane.sums);
    {
        const std::lock_guard lock(job.mutex);
        ++job.frame.launches;
        job.frame.timings.kernels += lane.kernel_seconds;
        if (counts) add(job.frame.statistics, task.statistics);
        if (area(task.region->shape) > area(job.frame.tile)) job.frame.tile = task.region->shape;
        job.traced += area(task.region->visible(job.settings.picture)) * (task.samples_end - task.samples_begin);
        const double all = static_cast<double>(area(job.settings.picture)) * job.settings.samples;
        if (job.hooks.progress) job.hooks.progress(std::min(static_cast<double>(job.traced) / all, 1.0));
    }
    if (complete) task.region.reset();
}

void launch(const Job& job, const Tracer& tracer, Task& task)
{
    task.samples_begin = task.samples_end;
    task.samples_end = std::min(task.samples_begin + tracer.most_samples(), job.settings.samples);
    task.lane->launch(*task.region, task.samples_begin, task.samples_end, task.samples_end == job.settings.samples);
    task.busy = true;
}

/// Takes regions until there are no more; `lanes` of them are under way at a time.
void work(Job& job, Worker& worker, std::size_t index, std::size_t lane_pixels)
{
    const std::size_t lanes = std::clamp(job.settings.in_flight, 1u, worker.tracer->most_in_flight());
    std::vector<Task> tasks;
    for (std::size_t turn = 0;; ++turn) {
        if (job.is_cancelled()) throw Interrupted();
        if (turn < lanes) tasks.emplace_back().lane = worker.tracer->make_lane(lane_pixels);
        Task& task = tasks[turn % lanes];
        if (task.busy) {
            job.hand_over();
            collect(job, task);
        }
        if (!task.region) {
            const bool idle = std::ranges::none_of(tasks, &Task::busy);
            task.region = idle ? job.regions.wait_and_take(index) : job.regions.take(index);
            if (!task.region && idle) return job.hand_over();
            if (!task.region) continue;
            task.samples_end = 0;
            task.statistics = {};
        }
        launch(job, *worker.tracer, task);
    }
}

/// One of several workers, in its thread. Whatever a device throws, the others go on.
void work_in_team(Job& job, std::span<Worker> team, std::size_t index, std::size_t lane_pixels)
{
    const auto give_up = [&](const std::string& why) {
        team[index].failure = why;
        job.regions.give_back(index);
        const std::lock_guard lock(job.mutex);
        job.failure = std::current_exception();
    };
    try {
        work(job, team[index], index, lane_pixels);
    } catch (const cl::Error& e) {
        give_up(explain(e));
    } catch (const Failure& e) {
        give_up(e.what());
    } catch (...) {
        job.stop();
    }
}

/// Launches of about so many seconds, and of no more pixels than memory should hold.
std::vector<Taker> takers_of(std::span<const Worker> team, const RenderSettings& settings, Shape cell)
{
    std::size_t most = most_region_pixels; // any may have to do what another failed to
    for (const Worker& w : team) most = std::min(most, w.tracer->most_pixels());
    std::vector<Taker> out;
    for (const Worker& w : team) {
        const double seconds = w.sample_seconds * std::min(settings.samples, w.tracer->most_samples());
        std::size_t pixels = most;
        if (settings.tile)
            pixels = area(cell);
        else if (seconds > 0)
            pixels = static_cast<std::size_t>(std::min(settings.launch_seconds / seconds, static_cast<double>(pixels)));
        out.push_back({w.sample_seconds * settings.samples, std::max(pixels, area(cell))});
    }
    return out;
}

Shape cell_of(std::span<const Worker> team, const RenderSettings& settings)
{
    Shape grain = team.front().tracer->grain();
    for (const Worker& w : team) grain = common_multiple(grain, w.tracer->grain());
    return round_up(settings.tile.value_or(least_cell), grain);
}

} // namespace

void warm_up(Tracer& tracer)
{
    const auto lane = tracer.make_lane(area(tracer.grain()));
    lane->launch({0, 0, tracer.grain()}, 0, 0, true);
    lane->wait();
}

Probe probe(Tracer& tracer, Shape picture, unsigned looks)
{
    const Shape shape = round_up({std::min(picture.width, 32u), std::min(picture.height, 32u)}, tracer.grain());
    const auto lane = tracer.make_lane(area(shape));
    Probe out;
    // Low in the picture and in its middle, where skies are rare.
    constexpr std::array<std::array<unsigned, 2>, 3> quarters = {{{2, 2}, {1, 3}, {3, 3}}};
    for (const auto& [qx, qy] : quarters) {
        const Region region{picture.width / 4 * qx, picture.height / 4 * qy, shape};
        const double seconds = least_seconds(*lane, region, looks);
        out.sample_seconds = std::max(out.sample_seconds, seconds / static_cast<double>(area(shape)));
        const Shape part = Region{region.x, region.y, least_cell}.visible(picture);
        for (unsigned j = 0; j < std::min(part.height, shape.height); ++j)
            for (unsigned i = 0; i < 4 * std::min(part.width, shape.width); ++i)
                if (i % 4 < 3) out.rgb.push_back(lane->sums[std::size_t{4} * shape.width * j + i]);
    }
    return out;
}

void trace_frame(std::span<Worker> team, const RenderSettings& settings, const RenderHooks& hooks, Frame& frame)
{
    const Shape cell = cell_of(team, settings);
    const std::vector<Taker> takers = takers_of(team, settings, cell);
    const auto most_rows =
        static_cast<unsigned>(std::min<std::size_t>(most_band_pixels / settings.picture.width, 65536));
    Job job{settings,
            hooks,
            frame,
            Regions(settings.picture, cell, takers, most_rows),
            Canvas(frame.picture, cell.height, settings.samples, hooks.rows),
            {},
            0,
            {},
            {}};
    frame.launches = 0;
    frame.tile = {};
    // A lane holds what its worker takes at most, and what another had that failed.
    std::size_t lane_pixels = 0;
    for (const Taker& t : takers) lane_pixels = std::max(lane_pixels, t.most_pixels);
    lane_pixels = std::min(lane_pixels, area(round_up(settings.picture, cell)));
    if (const std::size_t most = team.front().tracer->most_pixels(); lane_pixels > most)
        throw Failure(fmt::format("a tile of {}x{} is too large: the device holds {} pixels at most", cell.width,
                                  cell.height, most));
    if (team.size() == 1) {
        work(job, team.front(), 0, lane_pixels);
    } else {
        std::vector<std::jthread> threads;
        for (std::size_t i = 0; i < team.size(); ++i)
            threads.emplace_back([&, i] { work_in_team(job, team, i, lane_pixels); });
        threads.clear();
    }
    const Stopwatch rows;
    job.hand_over();
    frame.timings.rows = rows.seconds();
    if (job.end) std::rethrow_exception(job.end);
    if (!job.regions.is_complete()) std::rethrow_exception(job.failure);
}

} // namespace clucida::host
