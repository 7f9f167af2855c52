#include "host/launch_shape.h"

#include "host/program_cache.h"
#include "host/stopwatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace clucida::host {
namespace {

constexpr double longest = 1;    ///< s that all looks may take; the one under way is finished
constexpr double clearly = 0.97; ///< of the usual shape's time
constexpr unsigned most_group_side = 1024;

std::string key_of(const DeviceInfo& device)
{
    return cache_key("the shape of work-groups", CLUCIDA_VERSION, device);
}

} // namespace

std::optional<Shape> kept_group(const DeviceInfo& device)
{
    const auto text = load_cached(cache_folder(), key_of(device));
    Shape group;
    if (!text || std::sscanf(text->c_str(), "%ux%u", &group.width, &group.height) != 2) return std::nullopt;
    if (group.width - 1 >= most_group_side || group.height - 1 >= most_group_side) return std::nullopt;
    return group;
}

bool keep_group(const DeviceInfo& device, Shape group)
{
    return store_cached(cache_folder(), key_of(device), fmt::format("{}x{}", group.width, group.height));
}

std::vector<Shape> candidate_groups(std::size_t most_items)
{
    std::vector<Shape> out;
    for (const Shape s : {Shape{8, 4}, {32, 1}, {8, 8}, {16, 4}, {64, 1}, {16, 8}, {32, 4}, {16, 16}, {32, 8}})
        if (area(s) <= most_items) out.push_back(s);
    return out;
}

Shape fastest_group(Shape usual, const std::vector<Shape>& candidates, const TimeGroup& seconds)
{
    const Stopwatch watch;
    const std::optional<double> known = seconds(usual);
    Shape best = usual;
    double least = known.value_or(HUGE_VAL) * clearly;
    for (const Shape group : candidates) {
        if (watch.seconds() > longest) break;
        if (group == usual) continue;
        const std::optional<double> taken = seconds(group);
        if (!taken || *taken >= least) continue;
        best = group;
        least = *taken;
    }
    return best;
}

double least_seconds(Lane& lane, const Region& region, unsigned looks)
{
    double least = HUGE_VAL;
    for (unsigned i = 0; i < looks; ++i) {
        const Stopwatch watch;
        lane.launch(region, 0, 1, true);
        lane.wait();
        least = std::min(least, watch.seconds());
    }
    return least;
}

double time_middle(Tracer& tracer, Shape picture, std::size_t pixels)
{
    const double scale = std::min(std::sqrt(static_cast<double>(pixels) / static_cast<double>(area(picture))), 1.0);
    const Shape wanted{static_cast<unsigned>(scale * picture.width), static_cast<unsigned>(scale * picture.height)};
    const Shape shape = round_up(wanted, tracer.grain());
    const Region region{(picture.width - std::min(picture.width, shape.width)) / 2,
                        (picture.height - std::min(picture.height, shape.height)) / 2, shape};
    const auto lane = tracer.make_lane(area(shape));
    return least_seconds(*lane, region, 3); // the first, with whatever comes with it, is not the best
}

} // namespace clucida::host
