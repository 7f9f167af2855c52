#include "bench/ablations.h"

#include "bench/half_storage.h"
#include "bench/variants.h"

namespace clucida::bench {
namespace {

constexpr std::uint32_t all_lights =
    scene::feature_light_paper | scene::feature_light_lambert | scene::feature_light_inverse_square;
constexpr std::uint32_t all_skies =
    scene::feature_sky_gradient | scene::feature_sky_rgb | scene::feature_sky_hsv | scene::feature_sky_photograph;

using Each = std::uint64_t host::Statistics::*;

/// Collects the rows: each begins as the whole and says what is otherwise.
class Rows {
public:
    Rows(const AblationScene& scene, const host::RenderSettings& settings) : scene_(scene), settings_(settings)
    {
        add("all", How::whole);
    }

    Ablation& add(const std::string& name, How how, Each each = nullptr)
    {
        return rows_.emplace_back(Ablation{name, how, scene_.compiled, settings_, each, Stage::none});
    }
    void add_stage(const std::string& name, How how, const std::string& kernels, Stage stage = Stage::none,
                   Each each = nullptr)
    {
        Ablation& row = add(name, how, each);
        row.settings.kernels = stage_kernels(kernels);
        row.stage = stage;
    }
    /// Without features that the scene has: of those of which there are none there is no row.
    void add_without(const std::string& name, std::uint32_t features)
    {
        if (!(scene_.compiled.needs.features & features)) return;
        add(name, How::left_out).compiled.needs.features &= ~features;
    }
    std::vector<Ablation> take() { return std::move(rows_); }

private:
    const AblationScene& scene_;
    const host::RenderSettings& settings_;
    std::vector<Ablation> rows_;
};

void add_stages(Rows& rows, const AblationScene& scene)
{
    using host::Statistics;
    rows.add_stage("any search and all that follows", How::left_out, "unseen", Stage::observer, &Statistics::queries);
    rows.add_stage("shading, and all rays that follow", How::left_out, "unshaded");
    if (scene.counted.rays > scene.counted.primary) {
        Ablation& one_hop = rows.add("rays after the observer's", How::left_out);
        one_hop.compiled = scene.one_hop;
        one_hop.compiled.needs = scene.compiled.needs;
    }
    rows.add_stage("the quick search", How::twice, "searched_twice", Stage::search, &Statistics::queries);
    rows.add_stage("confirming surfaces", How::twice, "confirmed_twice", Stage::confirm, &Statistics::queries);
    if (scene.counted.full) rows.add_stage("the full search", How::twice, "full_twice", Stage::full, &Statistics::full);
    if (scene.counted.shadow)
        rows.add_stage("the search of shadow rays", How::left_out, "unhidden", Stage::shadow, &Statistics::shadow);
}

/// Fresnel's weights are no row: without them surfaces reflect all that their filters let pass, and rays multiply by
/// hundreds.
void add_features(Rows& rows)
{
    rows.add_without("lights", all_lights);
    rows.add_without("extinction in media", scene::feature_extinction);
    rows.add_without("photographs on surfaces", scene::feature_texture);
    rows.add_without("the sky but for a plain colour", all_skies);
}

void add_other_ways(Rows& rows, const AblationScene& scene, const host::RenderSettings& settings)
{
    const bool packets = scene.kernel == host::KernelShape::packets,
               twofold = settings.precision == host::Precision::twofold;
    rows.add(packets ? "the kernel of pixels" : "the kernel of packets", How::instead).settings.kernel =
        packets ? host::KernelShape::pixels : host::KernelShape::packets;
    if (scene.device.has_double || twofold)
        rows.add(twofold ? "float" : "double", How::instead).settings.precision =
            twofold ? host::Precision::single : host::Precision::twofold;
    rows.add_stage("the full search of every ray", How::instead, "full_search");
    rows.add("textbook arithmetic with an epsilon", How::instead).settings.kernels = variant_kernels("naive");
    rows.add("textbook arithmetic at the nearest point", How::instead).settings.kernels =
        variant_kernels("reoriginated");
}

/// Storage in halves: OpenCL C reads halves as floats only, unless it has an extension.
void add_halves(Rows& rows, const AblationScene& scene, const host::RenderSettings& settings)
{
    if (settings.precision != host::Precision::single) return;
    Ablation& boxes = rows.add("boxes stored in halves", How::instead);
    boxes.compiled = with_half_boxes(scene.compiled);
    boxes.settings.kernels = stage_kernels("half");
    rows.add("coordinates rounded to halves", How::instead).compiled = with_half_coordinates(scene.compiled);
    rows.add("colours rounded to halves", How::instead).compiled = with_half_colors(scene.compiled);
}

} // namespace

std::vector<Ablation> make_ablations(const AblationScene& scene, const host::RenderSettings& settings)
{
    host::RenderSettings same = settings;
    same.kernel = scene.kernel; // whatever becomes of the objects
    Rows rows(scene, same);
    add_stages(rows, scene);
    add_features(rows);
    add_other_ways(rows, scene, same);
    add_halves(rows, scene, same);
    return rows.take();
}

} // namespace clucida::bench
