/// Many rays against every primitive, through the native core, judged in a wider type: how far off the hits are, and
/// what never must happen. Prints a table; exits with 1 if a bound is broken. docs/numerics.md has its results.
#include "many_rays_make.h"

#include "host/share_work.h"
#include "scene/write.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <thread>

namespace clucida::test {
namespace {

constexpr double most_distance = 1e6; ///< in sizes: events beyond are not judged
constexpr unsigned rays_of_a_solid = 1000, attempts_at_a_solid = 20 * rays_of_a_solid;
constexpr std::size_t kept_cases = 3; ///< of each purpose

/// What a ray is meant to try; broken bounds are counted for each.
enum Purpose { to_pass_through, to_graze, to_follow_an_asymptote, to_leave, purposes };
constexpr std::array purpose_names{"through", "grazing", "asymptotic", "departing"};

/// How often an error of so many units was seen: 1/32 unit a bin, the last for all above.
struct Histogram {
    std::array<std::uint64_t, 512> bins{};
    double worst = 0;
    void add(double units)
    {
        worst = std::max(worst, units);
        bins[static_cast<std::size_t>(std::clamp(units * 32, 0.0, 511.0))]++;
    }
    void add(const Histogram& h)
    {
        worst = std::max(worst, h.worst);
        for (std::size_t i = 0; i < bins.size(); i++) bins[i] += h.bins[i];
    }
    /// A bound that holds for the given part of them.
    double percentile(double part) const
    {
        std::uint64_t all = 0, below = 0;
        for (const auto n : bins) all += n;
        for (std::size_t i = 0; i + 1 < bins.size(); i++) {
            below += bins[i];
            if (static_cast<double>(below) >= part * static_cast<double>(all)) return static_cast<double>(i + 1) / 32;
        }
        return worst;
    }
};

struct Tally {
    std::uint64_t rays = 0, departing = 0, hits = 0, unsure = 0, far = 0;
    std::array<std::uint64_t, purposes> broken_by{};
    std::uint64_t over = 0, flips = 0, wrong_side = 0, self_hits = 0, parity = 0, nans = 0, stuck = 0;
    Histogram histogram;
    std::array<std::vector<std::pair<double, std::string>>, purposes>
        cases; ///< what broke a bound: the worst, with all to see it again

    std::uint64_t broken() const { return over + flips + wrong_side + self_hits + parity + nans + stuck; }
    void keep(std::size_t purpose, double badness, std::string text)
    {
        auto& kept = cases[purpose];
        kept.emplace_back(badness, std::move(text));
        std::ranges::sort(kept, std::greater{});
        if (kept.size() > kept_cases) kept.pop_back();
    }
    void add(const Tally& t)
    {
        rays += t.rays, departing += t.departing, hits += t.hits, unsure += t.unsure, far += t.far;
        over += t.over, flips += t.flips, wrong_side += t.wrong_side, self_hits += t.self_hits;
        parity += t.parity, nans += t.nans, stuck += t.stuck;
        for (std::size_t i = 0; i < purposes; i++) broken_by[i] += t.broken_by[i];
        histogram.add(t.histogram);
        for (std::size_t i = 0; i < purposes; i++)
            for (const auto& [badness, text] : t.cases[i]) keep(i, badness, text);
    }
};

template <typename P>
class Trial {
public:
    using W = typename P::Wide;

    Trial(const SizedSolid& solid, double bound, Random& generator, Tally& result)
        : most_units(bound), scene(scene_of({solid.solid})), native(scene), target(target_of<W>(native, solid.size)),
          random(generator), tally(result)
    {
    }

    /// One ray to the solid, and two that leave where it meets it; none where none of the purpose can be made.
    void ray()
    {
        const auto die = random() % 10;
        const Purpose purpose = die < 6 ? to_pass_through : die < 9 ? to_graze : to_follow_an_asymptote;
        const auto path = purpose == to_pass_through ? through<P>(random, static_cast<double>(target.size))
                          : purpose == to_graze      ? grazing<P>(random, target)
                                                     : asymptotic<P>(random, target);
        if (!path) return;
        const std::optional<Hit> hit = judge(*path, purpose);
        if (!hit) return;
        for (const bool ahead : {true, false}) {
            const auto member =
                static_cast<std::size_t>(std::ranges::find(target.references, hit->left) - target.references.begin());
            const auto away = departing<P>(random, target, member, *hit, ahead);
            if (away) judge(*away, to_leave);
        }
    }

private:
    bool is_far(const Wide3<W>& p) const { return root(dot(p, p)) > W(most_distance) * target.size; }

    std::size_t member_left(const Path& path) const
    {
        return static_cast<std::size_t>(std::ranges::find(target.references, path.left) - target.references.begin());
    }

    /// The kernel's first event, if it is the right one.
    std::optional<Hit> judge(const Path& path, Purpose purpose)
    {
        const bool leaves = purpose == to_leave;
        const Wide3<W> o = widen<W>(path.o), d = widen<W>(path.d);
        const First<W> e = first_event(target, o, d, member_left(path), path.left_inside, rounding);
        inside.assign(e.inside ? 1 : 0, 0U);
        Stats stats{};
        const std::optional<Hit> hit = next_hit<P>(native, path, inside, stats);
        tally.rays++;
        tally.departing += leaves ? 1 : 0;
        const auto broken = [&](std::uint64_t& count, double badness, const std::string& what) {
            count++;
            tally.broken_by[purpose]++;
            const auto& kept = tally.cases[purpose];
            if (kept.size() < kept_cases || badness > kept.back().first)
                tally.keep(purpose, badness, describe(path, e, fmt::format("{} ray {}", purpose_names[purpose], what)));
        };
        if (stats[STAT_NAN] != 0 || (hit && !(scene::length(hit->p) + scene::length(hit->n) < 1e300)))
            broken(tally.nans, 1e9, "not a number");
        if (stats[STAT_STUCK] != 0) broken(tally.stuck, 1e9, "given up");
        if (e.unsure) {
            tally.unsure++;
            return std::nullopt;
        }
        if (stats[STAT_PARITY] != 0) broken(tally.parity, 1e8, "parity fault");
        if (e.hit ? is_far(along(o, d, e.t)) : hit && is_far(widen<W>(hit->p))) {
            tally.far++;
            return std::nullopt;
        }
        if (leaves && hit && !e.hit) {
            broken(tally.self_hits, 1e7, fmt::format("met again at {}", hit->t));
            return std::nullopt;
        }
        if (hit.has_value() != e.hit) {
            broken(tally.flips, 1e6, e.hit ? "missed" : fmt::format("invented at {}", hit->t));
            return std::nullopt;
        }
        if (!hit) return std::nullopt;
        tally.hits++;
        const bool beyond_inside = e.inside == target.leaf.inverse;
        if (hit->left != target.references[e.member] || hit->beyond_inside != beyond_inside ||
            hit->before != (e.inside ? 0U : vacuum) || hit->after != (e.inside ? vacuum : 0U)) {
            broken(tally.wrong_side, 1e5, "the wrong face or side");
            return std::nullopt;
        }
        const double units = error_units(target, e, o, d, hit->p, P::u);
        tally.histogram.add(units);
        if (!(units <= most_units)) {
            const bool met_itself = leaves && W(hit->t) < e.t / 2;
            broken(met_itself ? tally.self_hits : tally.over, units, fmt::format("off by {} units", units));
        }
        return hit;
    }

    /// All crossings of the line, so that a case can be understood as it is printed.
    std::string crossings(const Path& path) const
    {
        std::string text;
        for (std::size_t i = 0; i < target.leaf.members.size(); i++) {
            std::vector<Root<W>> roots;
            target.leaf.members[i].append_roots(widen<W>(path.o), widen<W>(path.d), W(0), roots);
            for (const Root<W>& r : roots)
                text += fmt::format("  member {} at t = {:.12g}, 1/cos {:.4g}\n", i, static_cast<double>(r.t),
                                    static_cast<double>(r.slope));
        }
        return text;
    }

    std::string describe(const Path& path, const First<W>& e, const std::string& what) const
    {
        return fmt::format("{}; expected {} t = {}, inside {}\n  o {:a} {:a} {:a}\n  d {:a} {:a} {:a}\n  left {:#x} "
                           "inside {}; size {}\n{}{}",
                           what, e.hit ? "an event at" : "none,", static_cast<double>(e.t), e.inside, path.o.x,
                           path.o.y, path.o.z, path.d.x, path.d.y, path.d.z, path.left, path.left_inside,
                           static_cast<double>(target.size), crossings(path), scene::print_scene(scene));
    }

    /// 8u x size is what a hit may be off by, so less than that decides nothing; two boundaries, twice that: they are
    /// crossed as one. Coordinates are stored as floats in both precisions.
    static constexpr Rounding<W> rounding{W(8 * P::u), W(16 * Float::u)};

    double most_units;
    Scene scene;
    Native native;
    Target<W> target;
    Random& random;
    Tally& tally;
    std::vector<u32> inside;
};

/// Solids are numbered, and each has random numbers of its own: the result is the same for any number of threads.
template <typename P>
Tally try_kind(const Kind& kind, std::uint64_t rays, std::uint64_t seed, unsigned threads)
{
    const std::uint64_t solids = (rays + rays_of_a_solid - 1) / rays_of_a_solid;
    std::vector<Tally> tallies(threads);
    host::share_work(solids, threads, [&](std::uint64_t i, unsigned worker) {
        Tally& tally = tallies[worker];
        Random random(seed * 0x9e3779b97f4a7c15ULL + i);
        Trial<P> trial(random_solid(random, kind), kind.most_units, random, tally);
        const std::uint64_t enough = tally.rays + rays_of_a_solid;
        for (unsigned k = 0; k < attempts_at_a_solid && tally.rays < enough; k++) trial.ray();
    });
    for (std::size_t i = 1; i < tallies.size(); i++) tallies[0].add(tallies[i]);
    return tallies[0];
}

nlohmann::json to_json(const std::string& name, const Tally& t)
{
    return {{"primitive", name},
            {"rays", t.rays},
            {"departing", t.departing},
            {"hits", t.hits},
            {"unsure", t.unsure},
            {"far", t.far},
            {"error",
             {{"p50", t.histogram.percentile(.5)},
              {"p99", t.histogram.percentile(.99)},
              {"p99.99", t.histogram.percentile(.9999)},
              {"max", t.histogram.worst}}},
            {"over", t.over},
            {"flips", t.flips},
            {"wrong_side", t.wrong_side},
            {"self_hits", t.self_hits},
            {"parity", t.parity},
            {"nans", t.nans},
            {"stuck", t.stuck}};
}

struct Options {
    std::uint64_t rays = 100000, seed = 1;
    unsigned threads = std::max(1U, std::thread::hardware_concurrency());
    std::string precision = "float", primitive, json;
};

/// Float judged in quad: whether long double is wide enough.
struct FloatInQuad : Float {
    using Wide = Quad;
};

int run(const Options& options)
{
    nlohmann::json report = nlohmann::json::array();
    bool right = true;
    fmt::print("| primitive | rays | departing | hits | unsure | error: 50 % | 99 % | 99.99 % | worst | over | flips | "
               "wrong side | self-hits | parity | NaN | stuck |\n"
               "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
    for (const Kind& kind : kinds) {
        if (!options.primitive.empty() && options.primitive != kind.name) continue;
        const auto try_it = options.precision == "double"          ? try_kind<Double>
                            : options.precision == "float-in-quad" ? try_kind<FloatInQuad>
                                                                   : try_kind<Float>;
        const Tally t = try_it(kind, options.rays, options.seed, options.threads);
        fmt::print(
            "| {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} | {} | {} | {} | {} | {} | {} |\n",
            kind.name, t.rays, t.departing, t.hits, t.unsure + t.far, t.histogram.percentile(.5),
            t.histogram.percentile(.99), t.histogram.percentile(.9999), t.histogram.worst, t.over, t.flips,
            t.wrong_side, t.self_hits, t.parity, t.nans, t.stuck);
        std::fflush(stdout);
        for (std::size_t i = 0; i < purposes; i++) {
            if (t.broken_by[i] == 0) continue;
            fmt::print(stderr, "{}: {} bounds broken by {} rays\n", kind.name, t.broken_by[i], purpose_names[i]);
            for (const auto& [badness, text] : t.cases[i]) fmt::print(stderr, "{}: {}\n", kind.name, text);
        }
        if (t.rays < options.rays)
            fmt::print(stderr, "{}: only {} of {} rays could be made\n", kind.name, t.rays, options.rays);
        right = right && t.broken() == 0 && t.hits > t.rays / 8 && t.rays >= options.rays;
        report.push_back(to_json(kind.name, t));
    }
    if (!options.json.empty()) std::ofstream(options.json) << report.dump(1) << '\n';
    return right && !report.empty() ? 0 : 1;
}

} // namespace
} // namespace clucida::test

int main(int argc, char** argv)
{
    clucida::test::Options options;
    CLI::App app("Many rays against every primitive, judged in a wider type.");
    app.add_option("--rays", options.rays, "of each primitive")->capture_default_str();
    app.add_option("--seed", options.seed)->capture_default_str();
    app.add_option("--threads", options.threads)->capture_default_str()->check(CLI::Range(1, 1024));
    app.add_option("--precision", options.precision, "of the core; float-in-quad is float judged in 113 bits")
        ->capture_default_str()
        ->check(CLI::IsMember({"float", "double", "float-in-quad"}));
    app.add_option("--primitive", options.primitive, "only this one");
    app.add_option("--json", options.json, "a file for the figures");
    CLI11_PARSE(app, argc, argv);
    return clucida::test::run(options);
}
