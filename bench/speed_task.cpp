#include "bench/speed_task.h"

#include <nlohmann/json.hpp>

namespace clucida::bench {
namespace {

SpeedContender without_view(SpeedContender c)
{
    c.view = {};
    return c;
}

} // namespace

bool same_process(const SpeedContender& a, const SpeedContender& b)
{
    return without_view(a) == without_view(b);
}

bool same_program(const SpeedContender& a, const SpeedContender& b)
{
    SpeedContender x = without_view(a), y = without_view(b);
    x.threads = y.threads = 0;
    return x == y;
}

scene::View view_of(const SpeedView& view)
{
    return {view.picture.width, view.picture.height, view.samples, view.max_hops, view.cutoff, {}};
}

nlohmann::ordered_json to_json(const SpeedView& view)
{
    nlohmann::ordered_json j = {
        {"width", view.picture.width}, {"height", view.picture.height}, {"samples", view.samples}};
    j["max_hops"] = view.max_hops ? nlohmann::ordered_json(*view.max_hops) : nullptr;
    j["cutoff"] = view.cutoff ? nlohmann::ordered_json(*view.cutoff) : nullptr;
    return j;
}

nlohmann::ordered_json to_json(const SpeedTask& task)
{
    const SpeedContender& c = task.contender;
    nlohmann::ordered_json j = {{"scene", task.scene.file},
                                {"format", task.scene.format},
                                {"allow_path", task.scene.allow_path},
                                {"as_original", task.scene.as_original},
                                {"device", c.device},
                                {"double", c.precision == host::Precision::twofold},
                                {"threads", c.threads},
                                {"compiler", task.native.compiler},
                                {"march", task.native.march},
                                {"folder", task.native.folder.string()},
                                {"interior", task.least_interior},
                                {"stack", task.least_stack}};
    j.update(to_json(c.view));
    if (c.kernel) j["packets"] = *c.kernel == host::KernelShape::packets;
    if (c.group) j["group"] = {c.group->width, c.group->height};
    return j;
}

SpeedView speed_view_of(const nlohmann::json& j, const SpeedView& otherwise)
{
    SpeedView out = otherwise;
    out.picture = {j.value("width", out.picture.width), j.value("height", out.picture.height)};
    out.samples = j.value("samples", out.samples);
    if (const auto hops = j.find("max_hops"); hops != j.end())
        out.max_hops = hops->is_null() ? std::nullopt : std::optional(hops->get<unsigned>());
    if (const auto cutoff = j.find("cutoff"); cutoff != j.end())
        out.cutoff = cutoff->is_null() ? std::nullopt : std::optional(cutoff->get<double>());
    return out;
}

SpeedTask task_of(const nlohmann::json& j)
{
    SpeedTask out;
    out.scene = {j.value("scene", out.scene.file), j.value("format", out.scene.format),
                 j.value("allow_path", out.scene.allow_path), j.value("as_original", out.scene.as_original)};
    SpeedContender& c = out.contender;
    c.device = j.value("device", c.device);
    if (j.value("double", false)) c.precision = host::Precision::twofold;
    c.threads = j.value("threads", c.threads);
    c.view = speed_view_of(j, c.view);
    if (j.contains("packets"))
        c.kernel = j.at("packets").get<bool>() ? host::KernelShape::packets : host::KernelShape::pixels;
    if (j.contains("group")) c.group = host::Shape{j.at("group").at(0), j.at("group").at(1)};
    out.native = {j.value("compiler", out.native.compiler), j.value("march", out.native.march),
                  j.value("folder", std::string())};
    out.least_interior = j.value("interior", 0U);
    out.least_stack = j.value("stack", 0U);
    return out;
}

} // namespace clucida::bench
