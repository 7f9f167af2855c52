#include "bench/speed_words.h"

#include "bench/median.h"
#include "bench/precision_name.h"

#include <fmt/format.h>

#include <algorithm>

namespace clucida::bench {
namespace {

constexpr std::size_t longest_name = 22, longest_failure = 100;

} // namespace

std::string place_name(const SpeedContender& c)
{
    return is_native(c) ? "native-build" : c.device;
}

std::string kernel_name(std::optional<host::KernelShape> kernel)
{
    if (!kernel) return "auto";
    return *kernel == host::KernelShape::packets ? "packets" : "pixels";
}

std::string size_name(host::Shape size)
{
    return fmt::format("{}x{}", size.width, size.height);
}

std::string hops_name(const SpeedView& view)
{
    return view.max_hops ? fmt::format("{}", *view.max_hops) : "scene";
}

std::string cutoff_name(const SpeedView& view)
{
    return view.cutoff ? fmt::format("{}", *view.cutoff) : "scene";
}

std::string group_name(const SpeedContender& c)
{
    return c.group ? size_name(*c.group) : "auto";
}

std::string thread_count(const SpeedReport& r)
{
    return r.threads ? std::to_string(r.threads) : "-";
}

std::string benchmark_name(const std::string& scene, const SpeedContender& c)
{
    std::string out = fmt::format("speed/{}/{}/{}/{}/threads:{}/{}", scene, place_name(c), kernel_name(c.kernel),
                                  precision_name(c.precision), c.threads ? std::to_string(c.threads) : "all",
                                  size_name(c.view.picture));
    if (c.view.samples != 1) out += fmt::format("/samples:{}", c.view.samples);
    if (c.view.max_hops) out += "/hops:" + hops_name(c.view);
    if (c.view.cutoff) out += "/cutoff:" + cutoff_name(c.view);
    if (c.group) out += "/group:" + group_name(c);
    return out;
}

std::string device_name(const SpeedReport& r)
{
    if (is_native(r.contender)) return "native-build";
    if (r.what.empty()) return r.contender.device;
    return r.what.size() > longest_name ? r.what.substr(0, longest_name - 3) + "..." : r.what;
}

std::optional<host::KernelShape> kernel_that_ran(const SpeedReport& r)
{
    return r.failure.empty() ? r.kernel : r.contender.kernel;
}

std::string brief(const std::string& failure)
{
    std::string out = failure.substr(0, std::min(failure.find('\n'), longest_failure));
    std::ranges::replace(out, '|', '/');
    return out;
}

double rays_of(const SpeedReport& r)
{
    return static_cast<double>(r.statistics.rays + r.statistics.shadow);
}

double nanoseconds_per_ray(const SpeedReport& r)
{
    return rays_of(r) > 0 ? 1e9 * median(r.real) / rays_of(r) : 0;
}

double millions_a_second(const SpeedReport& r, double count)
{
    return count / (1e6 * median(r.real));
}

} // namespace clucida::bench
