#include "bench/flips.h"

#include "bench/truth.h"
#include "host/errors.h"
#include "host/interrupt.h"

#include <algorithm>

namespace clucida::bench {
namespace {

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

} // namespace

Explained explain(const scene::Scene& scene, const oracle::Options& options, const FaceNames& names,
                  std::span<const PathFlip> flips, std::size_t most_flips, unsigned most_seeds, unsigned threads)
{
    std::vector<Open> open = choose(flips, most_flips);
    Explained out;
    out.looked_at = open.size();
    oracle::Options disturbed = options;
    while (!open.empty() && out.seeds < most_seeds) {
        if (host::interrupted()) throw host::Interrupted();
        out.seeds++;
        disturbed.disturbance = {out.seeds, flip_disturbance, out.seeds % 3 == 1, out.seeds % 3 == 2};
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
    out.explained = out.looked_at - open.size();
    for (const Open& o : open) out.unexplained.push_back(o.flip->pixel);
    return out;
}

} // namespace clucida::bench
