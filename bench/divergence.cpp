#include "bench/divergence.h"

#include "kernels/layout.h"

namespace clucida::bench {
namespace {

using oracle::Event;

constexpr std::uint32_t branches[] = {EVENT_REFLECTED, EVENT_REFRACTED}; // in the order of tracing

bool same_surface(const Event& a, const Event& b)
{
    constexpr std::uint32_t kind = EVENT_ENTERING | EVENT_EMITTED;
    return a.object == b.object && a.face == b.face && (a.what & kind) == (b.what & kind);
}

bool same(const Event& a, const Event& b)
{
    return same_surface(a, b) && a.what == b.what && a.lights == b.lights;
}

/// One path being read, segment by segment.
struct Reader {
    std::span<const Event> events;
    std::size_t at = 0;

    const Event& next() { return events[at++]; }
    bool done() const { return at >= events.size(); }
    /// Passes by the segment that comes next with all that follows from it.
    void skip()
    {
        if (done()) return;
        const Event event = next();
        for (const std::uint32_t branch : branches)
            if (event.what & branch) skip();
    }
    void skip_branches(const Event& event)
    {
        for (const std::uint32_t branch : branches)
            if (event.what & branch) skip();
    }
};

void compare(Reader& kernel, Reader& oracle, std::vector<Step>& way, std::vector<Divergence>& out)
{
    if (kernel.done() || oracle.done()) return; // a log that was cut short
    const std::size_t place = kernel.at;
    const Event k = kernel.next(), o = oracle.next();
    way.push_back({k, 0, place});
    if (!same(k, o)) out.push_back({way, o});
    if (same_surface(k, o)) {
        for (const std::uint32_t branch : branches) {
            const bool in_kernel = k.what & branch, in_oracle = o.what & branch;
            way.back().branch = branch;
            if (in_kernel && in_oracle)
                compare(kernel, oracle, way, out);
            else if (in_kernel)
                kernel.skip();
            else if (in_oracle)
                oracle.skip();
        }
    } else {
        kernel.skip_branches(k);
        oracle.skip_branches(o);
    }
    way.pop_back();
}

} // namespace

bool goes(const Event& event, const Step& step)
{
    if (step.branch == 0) return same(event, step.event);
    return same_surface(event, step.event) && (event.what & step.branch);
}

std::vector<Divergence> divergences(std::span<const Event> kernel, std::span<const Event> oracle)
{
    std::vector<Divergence> out;
    std::vector<Step> way;
    Reader k{kernel}, o{oracle};
    compare(k, o, way, out);
    return out;
}

bool has_way(std::span<const Event> path, const Divergence& divergence)
{
    Reader reader{path};
    for (const Step& step : divergence.way) {
        if (reader.done()) return false;
        const Event event = reader.next();
        if (!goes(event, step)) return false;
        if (step.branch == 0) return true;
        if (step.branch == EVENT_REFRACTED && (event.what & EVENT_REFLECTED)) reader.skip();
    }
    return false;
}

} // namespace clucida::bench
