#include "bench/steps.h"

#include "bench/disturbances.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/share_work.h"
#include "kernels/layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clucida::bench {
namespace {

using World = oracle::World<double>;
using Branch = oracle::Branch<double>;
using Three = std::array<double, 3>;
using host::SegmentRay;

Three eye_of(const World& world)
{
    return {world.observer.eye.x, world.observer.eye.y, world.observer.eye.z};
}

double distance(const Three& a, const Three& b)
{
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// The oracle's directions are of length 1, the kernels' to rounding only.
SegmentRay with_unit_direction(SegmentRay ray)
{
    const double length = std::hypot(ray.d[0], ray.d[1], ray.d[2]);
    for (double& x : ray.d) x /= length;
    return ray;
}

/// Of the oracle, in the kernels' terms.
SegmentRay ray_of(const Branch& branch, const Three& eye)
{
    SegmentRay out{branch.o, branch.d, branch.throughput};
    for (std::size_t k = 0; k < 3; k++) out.o[k] -= eye[k];
    return with_unit_direction(out);
}

Branch branch_of(const SegmentRay& ray, const Three& eye, const std::vector<oracle::Surface>& left, unsigned hop)
{
    Branch out{ray.o, ray.d, left, hop, ray.throughput};
    for (std::size_t k = 0; k < 3; k++) out.o[k] += eye[k];
    return out;
}

Deviation deviation(const SegmentRay& a, const SegmentRay& b)
{
    return {distance(a.o, b.o), distance(a.d, b.d), distance(a.throughput, b.throughput)};
}

Deviation larger(const Deviation& a, const Deviation& b)
{
    return {std::max(a.origin, b.origin), std::max(a.direction, b.direction), std::max(a.throughput, b.throughput)};
}

bool within(const Deviation& off, const Deviation& reach)
{
    return off.origin <= reach.origin && off.direction <= reach.direction && off.throughput <= reach.throughput;
}

SegmentRay mean_of(std::span<const SegmentRay> rays)
{
    SegmentRay out;
    for (const SegmentRay& r : rays) {
        for (std::size_t k = 0; k < 3; k++) {
            out.o[k] += r.o[k] / static_cast<double>(rays.size());
            out.d[k] += r.d[k] / static_cast<double>(rays.size());
            out.throughput[k] += r.throughput[k] / static_cast<double>(rays.size());
        }
    }
    return out;
}

/// The oracle's rays that follow one of the kernels' rays, undisturbed and disturbed.
struct Cloud {
    std::optional<SegmentRay> undisturbed;
    std::vector<SegmentRay> disturbed; ///< kept only where the undisturbed one goes another way

    void add(const SegmentRay& ray, bool is_undisturbed, const SegmentRay& kernel, StepVerdict& verdict)
    {
        verdict.met++;
        if (is_undisturbed) {
            undisturbed = ray;
            verdict.off = deviation(kernel, ray);
        } else if (undisturbed) {
            verdict.reach = larger(verdict.reach, deviation(ray, *undisturbed));
        } else {
            disturbed.push_back(ray);
            const SegmentRay middle = mean_of(disturbed);
            verdict.off = deviation(kernel, middle);
            verdict.reach = {};
            for (const SegmentRay& r : disturbed) verdict.reach = larger(verdict.reach, deviation(r, middle));
        }
        verdict.holds = verdict.holds || within(verdict.off, verdict.reach);
    }
};

/// A trail under judgement.
class Judge {
public:
    Judge(const Trail& trail, const FaceNames& names, Verdict& verdict)
        : trail_(trail), names_(names), verdict_(verdict), clouds_(trail.way.size()), left_(trail.way.size())
    {
        verdict_.steps.resize(trail.way.size() + 1);
        for (const SegmentRay& r : trail.rays) rays_.push_back(with_unit_direction(r));
    }

    bool done() const { return verdict_.holds(); }

    /// Takes all steps that are still in question in one world.
    void try_world(const World& world)
    {
        const Three eye = eye_of(world);
        const bool is_undisturbed = !world.disturbance;
        const oracle::Pixel& p = trail_.pixel;
        const std::uint64_t key = (std::uint64_t{p.y} * world.width + p.x) * 4096;
        if (!verdict_.steps[0].holds) {
            const Branch observer = oracle::observer_branch(world, p.x, p.y, p.sample);
            clouds_[0].add(ray_of(oracle::disturbed(world, observer, key), eye), is_undisturbed, rays_[0],
                           verdict_.steps[0]);
        }
        for (std::size_t i = 0; i < trail_.way.size(); i++) {
            if (i > 0 && !left_[i]) break; // no step led here yet
            if (settled(i)) continue;
            const Branch from =
                branch_of(rays_[i], eye, i > 0 ? *left_[i] : std::vector<oracle::Surface>{}, trail_.way[i].event.hop);
            const oracle::Segment<double> s = oracle::segment(world, oracle::disturbed(world, from, key + i + 1));
            if (!s.event || !goes(names_.oracle({&*s.event, 1})[0], trail_.way[i])) continue;
            StepVerdict& verdict = verdict_.steps[i + 1];
            if (i + 1 == trail_.way.size()) {
                verdict.met++;
                verdict.holds = true;
                continue;
            }
            const Branch& next = trail_.way[i].branch == EVENT_REFLECTED ? *s.reflected : *s.refracted;
            left_[i + 1] = next.left;
            clouds_[i + 1].add(ray_of(next, eye), is_undisturbed, rays_[i + 1], verdict);
        }
    }

private:
    /// Segment i holds, and so does the next, to which it says in what surfaces the ray starts.
    bool settled(std::size_t i) const
    {
        return verdict_.steps[i + 1].holds && (i + 1 == trail_.way.size() || verdict_.steps[i + 2].holds);
    }

    const Trail& trail_;
    const FaceNames& names_;
    Verdict& verdict_;
    std::vector<SegmentRay> rays_;
    std::vector<Cloud> clouds_; ///< of the rays with these numbers
    /// The surfaces that ray i starts in, as the step to it has them: that in the world at hand, or else in the last
    /// world in which it went the kernels' way.
    std::vector<std::optional<std::vector<oracle::Surface>>> left_;
};

} // namespace

bool Verdict::holds() const
{
    return std::ranges::all_of(steps, [](const StepVerdict& s) { return s.holds; });
}

std::vector<Verdict> judge_steps(const scene::Scene& scene, const oracle::Options& options, const FaceNames& names,
                                 std::span<const Trail> trails, unsigned most_seeds, unsigned threads)
{
    std::vector<Verdict> verdicts(trails.size());
    std::vector<Judge> open;
    for (std::size_t i = 0; i < trails.size(); i++) open.emplace_back(trails[i], names, verdicts[i]);
    oracle::Options disturbed = options;
    for (unsigned seed = 0; seed <= most_seeds && !open.empty(); seed++) {
        if (host::interrupted()) throw host::Interrupted();
        disturbed.disturbance.reset();
        if (seed > 0) disturbed.disturbance = flip_disturbance_of(seed);
        const auto world = oracle::build<double>(scene, disturbed);
        host::share_work(open.size(), threads, [&](std::size_t i, unsigned) { open[i].try_world(world); });
        std::vector<Judge> still;
        for (Judge& judge : open)
            if (!judge.done()) still.push_back(std::move(judge));
        open = std::move(still);
    }
    return verdicts;
}

std::string why_not(const Verdict& verdict)
{
    const auto failed = std::ranges::find_if(verdict.steps, [](const StepVerdict& s) { return !s.holds; });
    if (failed == verdict.steps.end()) return {};
    const auto number = failed - verdict.steps.begin();
    const std::string step = number == 0 ? "the observer's ray" : fmt::format("hop {}", number - 1);
    if (failed->met == 0) return step + ": met by no trial";
    return fmt::format("{}: met by {} trials; the next ray's origin is {:.2g} off, of {:.2g} within reach, its "
                       "direction {:.2g} of {:.2g}, its throughput {:.2g} of {:.2g}",
                       step, failed->met, failed->off.origin, failed->reach.origin, failed->off.direction,
                       failed->reach.direction, failed->off.throughput, failed->reach.throughput);
}

} // namespace clucida::bench
