#include "bench/speed_task.h"

#include <nlohmann/json.hpp>

namespace clucida::bench {

scene::View view_of(const SpeedTask& task)
{
    return {task.picture.width, task.picture.height, task.samples, task.max_hops, task.cutoff, {}};
}

nlohmann::ordered_json to_json(const SpeedTask& task)
{
    nlohmann::ordered_json j = {{"scene", task.scene.file},
                                {"format", task.scene.format},
                                {"allow_path", task.scene.allow_path},
                                {"as_original", task.scene.as_original},
                                {"width", task.picture.width},
                                {"height", task.picture.height},
                                {"samples", task.samples},
                                {"device", task.contender.device},
                                {"double", task.contender.precision == host::Precision::twofold},
                                {"threads", task.contender.threads},
                                {"compiler", task.native.compiler},
                                {"march", task.native.march},
                                {"folder", task.native.folder.string()},
                                {"interior", task.least_interior},
                                {"stack", task.least_stack}};
    if (task.contender.kernel) j["packets"] = *task.contender.kernel == host::KernelShape::packets;
    if (task.max_hops) j["max_hops"] = *task.max_hops;
    if (task.cutoff) j["cutoff"] = *task.cutoff;
    return j;
}

SpeedTask task_of(const nlohmann::json& j)
{
    SpeedTask out;
    out.scene = {j.value("scene", out.scene.file), j.value("format", out.scene.format),
                 j.value("allow_path", out.scene.allow_path), j.value("as_original", out.scene.as_original)};
    out.picture = {j.value("width", out.picture.width), j.value("height", out.picture.height)};
    out.samples = j.value("samples", out.samples);
    if (j.contains("max_hops")) out.max_hops = j.at("max_hops").get<unsigned>();
    if (j.contains("cutoff")) out.cutoff = j.at("cutoff").get<double>();
    out.contender = {j.value("device", out.contender.device),
                     j.value("double", false) ? host::Precision::twofold : host::Precision::single,
                     j.value("threads", out.contender.threads),
                     {}};
    if (j.contains("packets"))
        out.contender.kernel = j.at("packets").get<bool>() ? host::KernelShape::packets : host::KernelShape::pixels;
    out.native = {j.value("compiler", out.native.compiler), j.value("march", out.native.march),
                  j.value("folder", std::string())};
    out.least_interior = j.value("interior", 0U);
    out.least_stack = j.value("stack", 0U);
    return out;
}

} // namespace clucida::bench
