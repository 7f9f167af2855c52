#include "bench/speed_axes.h"

#include "host/arguments.h"
#include "host/errors.h"

#include <fmt/format.h>

#include <charconv>

namespace clucida::bench {
namespace {

constexpr unsigned most_threads = 1024, most_hops = 1000000, most_samples = 1U << 20;

/// The whole text as a number within least and most.
template <class Number>
Number number_in(const std::string& text, Number least, Number most, const std::string& what, const char* word)
{
    Number out{};
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, out);
    if (error == std::errc() && end == last && out >= least && out <= most) return out;
    throw host::UsageError(
        fmt::format("{} '{}' is wrong: expected {}a number from {} to {}", what, text, word, least, most));
}

std::vector<SpeedView> views_of(const SpeedAxes& axes)
{
    std::vector<SpeedView> out;
    for (const host::Shape picture : axes.pictures)
        for (const unsigned samples : axes.samples)
            for (const auto& hops : axes.max_hops)
                for (const auto& cutoff : axes.cutoffs) out.push_back({picture, samples, hops, cutoff});
    return out;
}

using Groups = std::vector<std::optional<host::Shape>>;

/// The groups that the kernel has on the device.
Groups groups_for(const SpeedAxes& axes, const host::DeviceInfo& device, std::optional<host::KernelShape> kernel)
{
    const host::KernelShape runs = kernel.value_or(host::kernel_shape(device, 1));
    return runs == host::KernelShape::pixels ? axes.groups : Groups{std::nullopt};
}

std::size_t factor(const SpeedAxes& a)
{
    return a.pictures.size() * a.samples.size() * a.max_hops.size() * a.cutoffs.size();
}

void require_possible(std::size_t contenders, const std::vector<SpeedContender>& processes)
{
    if (contenders > most_contenders)
        throw host::UsageError(fmt::format("that would be {} contenders; at most {} are possible, so give fewer values",
                                           contenders, most_contenders));
    if (processes.size() > most_processes)
        throw host::UsageError(fmt::format("that would take {} processes at a time, one for each device, precision, "
                                           "kernel, local size and number of threads; at most {} are possible",
                                           processes.size(), most_processes));
}

} // namespace

std::vector<SpeedContender> contenders_of(const SpeedAxes& axes)
{
    std::vector<SpeedContender> processes;
    for (const host::Precision precision : axes.precisions) {
        for (const host::DeviceInfo& device : axes.devices) {
            const bool limited = device.kind == host::DeviceKind::cpu;
            for (const auto& kernel : axes.kernels)
                for (const auto& group : groups_for(axes, device, kernel))
                    for (const unsigned limit : limited ? axes.threads : std::vector{0U})
                        processes.push_back({host::place(device), precision, limit, kernel, group, {}});
        }
        if (!axes.native) continue;
        for (const auto& kernel : axes.kernels)
            for (const unsigned limit : axes.threads) processes.push_back({"", precision, limit, kernel, {}, {}});
    }
    require_possible(processes.size() * factor(axes), processes);
    std::vector<SpeedContender> out;
    const std::vector<SpeedView> views = views_of(axes);
    for (SpeedContender c : processes)
        for (const SpeedView& view : views) {
            c.view = view;
            out.push_back(c);
        }
    return out;
}

unsigned parse_thread_limit(const std::string& text)
{
    return text == "all" ? 0 : number_in(text, 1U, most_threads, "threads", "all or ");
}

std::optional<host::KernelShape> parse_kernel(const std::string& text)
{
    if (text == "auto") return std::nullopt;
    return text == "packets" ? host::KernelShape::packets : host::KernelShape::pixels;
}

std::optional<host::Shape> parse_local_size(const std::string& text)
{
    if (text == "auto") return std::nullopt;
    return host::parse_size(text, "the local size");
}

std::optional<unsigned> parse_max_hops(const std::string& text)
{
    if (text == "scene") return std::nullopt;
    return number_in(text, 1U, most_hops, "--max-hops", "scene or ");
}

std::optional<double> parse_cutoff(const std::string& text)
{
    if (text == "scene") return std::nullopt;
    return number_in(text, 0.0, 1.0, "--cutoff", "scene or ");
}

unsigned parse_samples(const std::string& text)
{
    return number_in(text, 1U, most_samples, "--samples", "");
}

} // namespace clucida::bench
