#include "bench/flips.h"

#include "bench/disturbances.h"
#include "bench/steps.h"
#include "bench/truth.h"
#include "host/errors.h"
#include "host/interrupt.h"

#include <algorithm>

namespace clucida::bench {
namespace {

constexpr std::size_t traced_at_once = 256; ///< whole paths with all their rays take room
constexpr unsigned whole_path_seeds = 60;   ///< what few disturbances do not explain, more seldom do

/// A flip whose remaining divergences no disturbance has explained yet.
struct Open {
    const PathFlip* flip;
    std::vector<const Divergence*> divergences;
};

std::vector<Open> choose(std::span<const PathFlip> flips, std::size_t most)
{
    std::vector<Open> out;
    const std::size_t count = std::min(flips.size(), most);
    for (std::size_t i = 0; i < count; i++) {
        const PathFlip& flip = flips[i * flips.size() / count];
        out.push_back({&flip, {}});
        for (const Divergence& d : flip.divergences) out.back().divergences.push_back(&d);
    }
    return out;
}

/// Takes away what the oracle's whole paths explain.
void try_whole_paths(std::vector<Open>& open, const scene::Scene& scene, const oracle::Options& options,
                     const FaceNames& names, unsigned most_seeds, unsigned threads)
{
    oracle::Options disturbed = options;
    for (unsigned seed = 1; seed <= most_seeds && !open.empty(); seed++) {
        if (host::interrupted()) throw host::Interrupted();
        disturbed.disturbance = flip_disturbance_of(seed);
        std::vector<oracle::Pixel> pixels;
        pixels.reserve(open.size());
        for (const Open& o : open) pixels.push_back(o.flip->pixel);
        const std::vector<oracle::Path> paths = make_truth(scene, disturbed, RealType::float64, threads)(pixels);
        for (std::size_t i = 0; i < open.size(); i++) {
            const std::vector<oracle::Event> events = names.oracle(paths[i].events);
            std::erase_if(open[i].divergences, [&](const Divergence* d) { return has_way(events, *d); });
        }
        std::erase_if(open, [](const Open& o) { return o.divergences.empty(); });
    }
}

/// The ways that are still in question, each with its rays.
std::vector<Trail> trails_of(std::span<const Open> open, const PathsOf& paths_of)
{
    std::vector<Trail> out;
    for (std::size_t begin = 0; begin < open.size(); begin += traced_at_once) {
        const std::span<const Open> some = open.subspan(begin, std::min(traced_at_once, open.size() - begin));
        std::vector<oracle::Pixel> pixels;
        for (const Open& o : some) pixels.push_back(o.flip->pixel);
        const std::vector<host::PixelPath> paths = paths_of(pixels);
        for (std::size_t i = 0; i < some.size(); i++) {
            for (const Divergence* d : some[i].divergences) {
                Trail trail{pixels[i], d->way, {}};
                for (const Step& step : d->way) trail.rays.push_back(paths[i].rays.at(step.place));
                out.push_back(std::move(trail));
            }
        }
    }
    return out;
}

} // namespace

Explained explain(const scene::Scene& scene, const oracle::Options& options, const FaceNames& names,
                  std::span<const PathFlip> flips, const PathsOf& paths_of, std::size_t most_flips, unsigned most_seeds,
                  unsigned threads)
{
    std::vector<Open> open = choose(flips, most_flips);
    Explained out;
    out.looked_at = open.size();
    try_whole_paths(open, scene, options, names, std::min(most_seeds, whole_path_seeds), threads);
    if (!open.empty()) {
        const std::vector<Trail> trails = trails_of(open, paths_of);
        const std::vector<Verdict> verdicts = judge_steps(scene, options, names, trails, most_seeds, threads);
        std::size_t next = 0;
        for (const Open& o : open) {
            std::string why;
            for (std::size_t i = 0; i < o.divergences.size(); i++, next++)
                if (why.empty()) why = why_not(verdicts[next]);
            if (why.empty())
                out.step_by_step++;
            else
                out.unexplained.push_back({o.flip->pixel, why});
        }
    }
    out.explained = out.looked_at - out.unexplained.size();
    return out;
}

} // namespace clucida::bench
