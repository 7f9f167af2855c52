#include "bench/measure_error.h"

#include "bench/median.h"
#include "bench/variants.h"
#include "host/errors.h"
#include "host/flip.h"
#include "host/interrupt.h"
#include "host/signatures.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

namespace clucida::bench {
namespace {

constexpr std::size_t chunk_pixels = 8192;
constexpr unsigned usual_events = 64; ///< of a path; those with more are traced again
constexpr double near = 1e-5;         ///< an error of a channel from which on the oracle is asked more precisely
constexpr std::size_t sampled_flips = 500;
constexpr unsigned sampled_seeds = 60, shallow_hops = 4;
constexpr double less_cutoff = 16, more_hops = 2;

/// A contender at work.
struct Contest {
    host::RenderSettings settings;
    host::Renderer renderer;
    scene::Needs needs;
    std::optional<host::PathTracer> tracer{};
    std::vector<PathFlip> flips{};
    ErrorReport report{};
};

scene::View view_of(const ErrorSettings& settings, const host::SceneSource& source)
{
    scene::View view;
    view.width = settings.picture.width;
    view.height = settings.picture.height;
    view.as_original = source.as_original;
    return view;
}

host::RenderSettings render_settings(const ErrorSettings& settings, const Contender& contender)
{
    host::RenderSettings out;
    out.picture = settings.picture;
    out.precision = contender.precision;
    out.kernels = variant_kernels(contender.variant);
    return out;
}

/// Renders the picture some times, and readies the tracing of paths.
std::unique_ptr<Contest> enter(const Contender& contender, const host::Device& device, const scene::Compiled& compiled,
                               const ErrorSettings& settings)
{
    auto out = std::make_unique<Contest>(
        Contest{render_settings(settings, contender), host::make_renderer(device), {}, {}, {}, {}});
    ErrorReport& report = out->report;
    report.contender = contender;
    std::vector<double> seconds;
    for (unsigned i = 0; i < settings.repeats; i++) {
        const host::Frame frame = host::render_frame(out->renderer, compiled, out->settings, {{}, host::interrupted});
        seconds.push_back(frame.timings.trace);
        report.statistics = frame.statistics;
        report.device = frame.device;
        out->needs = frame.needs;
    }
    report.milliseconds = 1e3 * median(seconds);
    report.fastest = 1e3 * *std::ranges::min_element(seconds);
    report.slowest = 1e3 * *std::ranges::max_element(seconds);
    report.pixels = std::size_t{settings.picture.width} * settings.picture.height;
    report.picture = host::make_picture(settings.picture.width, settings.picture.height);
    out->tracer.emplace(host::make_path_tracer(out->renderer, compiled, out->needs, out->settings));
    return out;
}

/// The kernels' paths of the pixels, whole.
std::vector<host::PixelPath> whole_paths(Contest& contest, std::span<const oracle::Pixel> pixels,
                                         host::KeepRays keep_rays = host::KeepRays::no)
{
    std::vector<host::Pixel> places;
    for (const oracle::Pixel& p : pixels) places.push_back({p.x, p.y});
    host::Statistics unused;
    std::vector<host::PixelPath> out = host::trace_paths(*contest.tracer, places, 0, usual_events, unused, keep_rays);
    std::vector<host::Pixel> again;
    std::vector<std::size_t> which;
    unsigned most = 0;
    for (std::size_t i = 0; i < out.size(); i++) {
        if (out[i].events <= usual_events) continue;
        again.push_back(places[i]);
        which.push_back(i);
        most = std::max(most, out[i].events);
    }
    std::vector<host::PixelPath> longer = host::trace_paths(*contest.tracer, again, 0, most, unused, keep_rays);
    for (std::size_t i = 0; i < which.size(); i++) out[which[i]] = std::move(longer[i]);
    return out;
}

bool is_near(const host::PixelPath& path, const oracle::Path& truth)
{
    for (std::size_t k = 0; k < 3; k++)
        if (!(std::fabs(path.rgb[k] - truth.rgb[k]) <= near * std::max(1.0, truth.rgb[k]))) return false;
    return true;
}

void set_pixel(host::Picture& picture, const oracle::Pixel& at, const auto& rgb)
{
    for (std::size_t k = 0; k < 3; k++)
        picture.rgb[3 * (std::size_t{at.y} * picture.width + at.x) + k] = static_cast<float>(rgb[k]);
}

/// What all contenders are judged by.
struct Judgement {
    Truth truth, sharper; ///< sharper: what is asked where a path or a colour differs
    FaceNames names;
};

/// Judges some pixels: their true colours go to the picture, contenders' colours and flips to their reports.
void judge(std::span<const oracle::Pixel> pixels, const Judgement& by, std::span<const std::unique_ptr<Contest>> field,
           host::Picture& truth_picture)
{
    std::vector<oracle::Path> truth = by.truth(pixels);
    std::vector<std::vector<host::PixelPath>> paths;
    std::set<std::size_t> doubtful;
    const auto differences = [&](std::size_t contender, std::size_t i) {
        return divergences(by.names.kernel(paths[contender][i].log), by.names.oracle(truth[i].events));
    };
    const auto is_full = [&](std::size_t contender) {
        return field[contender]->report.contender.variant == full_variant;
    };
    for (std::size_t c = 0; c < field.size(); c++) {
        paths.push_back(whole_paths(*field[c], pixels));
        if (!is_full(c)) continue; // others differ too often to ask for each
        for (std::size_t i = 0; i < pixels.size(); i++)
            if (!is_near(paths[c][i], truth[i]) || !differences(c, i).empty()) doubtful.insert(i);
    }
    std::vector<oracle::Pixel> asked;
    asked.reserve(doubtful.size());
    for (const std::size_t i : doubtful) asked.push_back(pixels[i]);
    std::vector<oracle::Path> answers = by.sharper(asked);
    std::size_t next = 0;
    for (const std::size_t i : doubtful) truth[i] = std::move(answers[next++]);

    for (std::size_t i = 0; i < pixels.size(); i++) {
        set_pixel(truth_picture, pixels[i], truth[i].rgb);
        for (std::size_t c = 0; c < field.size(); c++) {
            set_pixel(field[c]->report.picture, pixels[i], paths[c][i].rgb);
            if (is_full(c) && !doubtful.contains(i)) continue; // known to agree
            std::vector<Divergence> found = differences(c, i);
            if (!found.empty()) field[c]->flips.push_back({pixels[i], std::move(found)});
        }
    }
}

/// The pixels without a flip, as a picture of one row.
host::Picture without_flips(const host::Picture& picture, std::span<const PathFlip> flips)
{
    std::vector<bool> flipped(std::size_t{picture.width} * picture.height);
    for (const PathFlip& f : flips) flipped[std::size_t{f.pixel.y} * picture.width + f.pixel.x] = true;
    host::Picture out;
    for (std::size_t i = 0; i < flipped.size(); i++)
        if (!flipped[i]) out.rgb.insert(out.rgb.end(), &picture.rgb[3 * i], &picture.rgb[3 * i] + 3);
    out.height = 1;
    out.width = static_cast<unsigned>(out.rgb.size() / 3);
    return out;
}

void compare_pictures(Contest& contest, const host::Picture& truth)
{
    ErrorReport& report = contest.report;
    const host::Picture mine = without_flips(report.picture, contest.flips), its = without_flips(truth, contest.flips);
    report.flips = contest.flips.size();
    report.shallow_flips = static_cast<std::size_t>(std::ranges::count_if(contest.flips, [](const PathFlip& f) {
        return std::ranges::any_of(f.divergences, [](const Divergence& d) { return d.oracle.hop < shallow_hops; });
    }));
    report.agreeing = host::compare(mine, its, 0);
    report.agreeing_equal = equal_share(mine, its);
    report.all = host::compare(report.picture, truth, 0);
    report.flip = host::flip(report.picture, truth).mean;
}

/// Of what the scene's own settings spare.
void measure_costs(SceneError& out, const host::SceneSource& source, const scene::View& view, Contest& contest)
{
    const auto picture = [&](const scene::View& v) {
        return host::render_frame(contest.renderer, compile_scene(source, v), contest.settings, {{}, host::interrupted})
            .picture;
    };
    const host::Picture& as_is = contest.report.picture;
    scene::View other = view;
    other.cutoff = source.scene.settings.cutoff / less_cutoff;
    out.cutoff = cost_of(as_is, picture(other));
    other = view;
    other.max_hops = static_cast<unsigned>(source.scene.settings.max_hops * more_hops);
    out.hops = cost_of(as_is, picture(other));
}

std::vector<oracle::Pixel> all_pixels(host::Shape picture)
{
    std::vector<oracle::Pixel> out;
    out.reserve(std::size_t{picture.width} * picture.height);
    for (unsigned y = 0; y < picture.height; y++)
        for (unsigned x = 0; x < picture.width; x++) out.push_back({x, y, 0});
    return out;
}

} // namespace

double unexplained_flips(const ErrorReport& report)
{
    const Explained& e = report.explained;
    if (e.looked_at == 0) return 0;
    return static_cast<double>(e.unexplained.size() * report.flips) / static_cast<double>(e.looked_at);
}

SceneError measure_error(const host::SceneSource& source, const host::Device& device, const ErrorSettings& settings,
                         const std::function<void(double)>& progress)
{
    const scene::View view = view_of(settings, source);
    const scene::Compiled compiled = compile_scene(source, view);
    const oracle::Options options{view, true, {}};
    const Judgement by{make_truth(source.scene, options, settings.oracle, settings.threads),
                       make_truth(source.scene, options, std::max(settings.oracle, RealType::quad), settings.threads),
                       match_faces(source.scene, compiled)};
    std::vector<std::unique_ptr<Contest>> field;
    for (const Contender& c : settings.contenders) field.push_back(enter(c, device, compiled, settings));

    SceneError out;
    out.truth = host::make_picture(view.width, view.height);
    const std::vector<oracle::Pixel> pixels = all_pixels(settings.picture);
    for (std::size_t begin = 0; begin < pixels.size(); begin += chunk_pixels) {
        if (host::interrupted()) throw host::Interrupted();
        const std::size_t count = std::min(chunk_pixels, pixels.size() - begin);
        judge(std::span(pixels).subspan(begin, count), by, field, out.truth);
        if (progress) progress(static_cast<double>(begin + count) / static_cast<double>(pixels.size()));
    }
    for (const auto& contest : field) {
        compare_pictures(*contest, out.truth);
        const bool full = contest->report.contender.variant == full_variant; // of others a sample tells enough
        const std::size_t most = full ? settings.most_explained : std::min(settings.most_explained, sampled_flips);
        const unsigned seeds = full ? settings.seeds : std::min(settings.seeds, sampled_seeds);
        const auto paths_of = [&](std::span<const oracle::Pixel> asked) {
            return whole_paths(*contest, asked, host::KeepRays::yes);
        };
        contest->report.explained =
            explain(source.scene, options, by.names, contest->flips, paths_of, most, seeds, settings.threads);
        contest->report.kernel = measure_kernel_error(contest->renderer, source.scene, compiled, contest->needs,
                                                      contest->settings, by.names, settings.threads);
    }
    if (settings.costs) {
        const OracleCosts costs = oracle_costs(source.scene, view, pixels, settings.threads);
        out.rounding = costs.rounding;
        out.colors = costs.colors;
        measure_costs(out, source, view, *field.front());
    }
    for (const auto& contest : field) out.reports.push_back(std::move(contest->report));
    return out;
}

} // namespace clucida::bench
