#include "bench/time_ablations.h"

#include "bench/median.h"
#include "bench/spread.h"
#include "host/interrupt.h"

namespace clucida::bench {
namespace {

constexpr double least_turn = 0.05;     ///< s
constexpr double most_more_rays = 1.02; ///< with which a row still tells what something costs

/// With a renderer of its own, which keeps its program.
struct Contender {
    Ablation ablation;
    host::Renderer renderer;
    AblationTime time;
};

/// A turn: renders the frame for a while, at least once, and notes the medians of its times.
void render(Contender& c)
{
    std::vector<double> real, device, cpu;
    double sum = 0;
    do {
        host::Frame frame =
            host::render_frame(c.renderer, c.ablation.compiled, c.ablation.settings, {{}, host::interrupted, {}});
        c.ablation.compiled.needs = frame.needs;
        c.time.counted = frame.statistics;
        c.time.picture = std::move(frame.picture);
        real.push_back(frame.timings.trace);
        device.push_back(frame.timings.kernels);
        cpu.push_back(frame.timings.trace_cpu);
        sum += frame.timings.trace;
    } while (sum < least_turn);
    c.time.real.push_back(median(real));
    c.time.device.push_back(median(device));
    c.time.cpu.push_back(median(cpu));
}

void forget_times(AblationTime& time)
{
    time.real.clear();
    time.device.clear();
    time.cpu.clear();
}

void judge(Contender& c, const Contender& whole, const host::DeviceInfo& device)
{
    const std::vector<double>& times = counting_times(c.time, device);
    const std::vector<double>& all = counting_times(whole.time, device);
    std::vector<double> costs, ratios;
    for (std::size_t i = 0; i < times.size(); ++i) {
        costs.push_back(c.ablation.how == How::left_out ? all[i] - times[i] : times[i] - all[i]);
        ratios.push_back(times[i] / all[i]);
    }
    c.time.cost = median(costs);
    c.time.cost_spread = interquartile_range(costs);
    c.time.share = c.time.cost / median(all);
    c.time.ratio = median(ratios);
    const std::uint64_t count = c.ablation.each ? whole.time.counted.*c.ablation.each : 0;
    if (count) c.time.each = 1e9 * c.time.cost / static_cast<double>(count);
    c.time.change = host::compare(c.time.picture, whole.time.picture, 0);
}

} // namespace

bool counts_by_processor(const host::DeviceInfo& device)
{
    return device.kind == host::DeviceKind::cpu;
}

const std::vector<double>& counting_times(const AblationTime& time, const host::DeviceInfo& device)
{
    return counts_by_processor(device) ? time.cpu : time.real;
}

std::vector<AblationTime> time_ablations(const host::Device& device, std::vector<Ablation> ablations, unsigned rounds,
                                         const std::function<void(double)>& progress)
{
    std::vector<Contender> contenders;
    double done = 0;
    const auto advance = [&] { progress(++done / static_cast<double>((rounds + 1) * ablations.size())); };
    for (Ablation& ablation : ablations) {
        contenders.push_back({std::move(ablation), host::make_renderer(device, host::Profiling::yes), {}});
        Contender& c = contenders.back();
        c.time.name = c.ablation.name;
        c.time.how = c.ablation.how;
        c.time.stage = c.ablation.stage;
        render(c);
        forget_times(c.time);
        c.time.meaningless = c.ablation.how == How::left_out &&
                             static_cast<double>(c.time.counted.rays) >
                                 most_more_rays * static_cast<double>(contenders.front().time.counted.rays);
        advance();
    }
    for (unsigned round = 0; round < rounds; ++round)
        for (std::size_t turn = 0; turn < contenders.size(); ++turn, advance())
            if (Contender& c = contenders[(round + turn) % contenders.size()]; !c.time.meaningless)
                render(c); // nobody always comes first
    std::vector<AblationTime> out;
    out.reserve(contenders.size());
    for (Contender& c : contenders)
        if (!c.time.meaningless) judge(c, contenders.front(), device.info);
    for (Contender& c : contenders) out.push_back(std::move(c.time));
    return out;
}

} // namespace clucida::bench
