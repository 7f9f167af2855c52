#include "bench/profile_code.h"

#include "bench/disassembly.h"
#include "bench/worker_process.h"
#include "host/atomic_file.h"

#include <nlohmann/json.hpp>

#include <algorithm>

namespace clucida::bench {
namespace {

constexpr unsigned rounds = 9;         ///< of the picture that is timed
constexpr double least_seconds = 0.05; ///< of each of them

host::Statistics statistics_of(const nlohmann::json& answer)
{
    host::Statistics out;
    for (const host::StatisticsField& f : host::statistics_fields())
        out.*f.value = answer.at("statistics").at(f.name).get<std::uint64_t>();
    return out;
}

} // namespace

StaticCode static_code(const std::string& what, const std::filesystem::path& folder)
{
    StaticCode out{what, {}, {}};
    for (const std::filesystem::path& file : machine_code_in(folder)) {
        for (const CodeFunction& f : disassemble(file)) {
            if (f.code.empty()) continue;
            out.functions.push_back({f.name, mix_of(f)});
            add(out.all, out.functions.back().mix);
        }
    }
    std::ranges::sort(out.functions, {}, [](const FunctionMix& f) { return -static_cast<double>(f.mix.instructions); });
    return out;
}

ExecutedPicture count_executed(SpeedTask task, const std::filesystem::path& folder)
{
    const bool packets = task.contender.kernel.value_or(host::KernelShape::packets) == host::KernelShape::packets;
    const bool twofold = task.contender.precision == host::Precision::twofold;
    task.contender.device.clear();
    task.contender.threads = 1;
    task.native.march = "haswell";
    task.native.folder = folder;
    nlohmann::json open = to_json(task);
    open["do"] = "open";
    const nlohmann::json turn = {{"do", "turn"}, {"least_seconds", least_seconds}};

    ExecutedPicture out;
    out.picture = task.contender.view.picture;
    {
        WorkerProcess worker(task.scene.file, "speed-worker", {});
        out.what = worker.ask(open).at("what");
        nlohmann::json answer;
        for (unsigned round = 0; round < rounds; ++round) {
            answer = worker.ask(turn);
            const double cpu = answer.at("cpu");
            out.cpu = round ? std::min(out.cpu, cpu) : cpu;
        }
        out.counted = statistics_of(answer);
        open["interior"] = answer.at("interior"); // so that no picture is rendered twice below
        open["stack"] = answer.at("stack");
    }
    const std::filesystem::path requests = folder / "requests";
    host::write_file(requests, open.dump() + "\n" + R"({"do": "turn"})" + "\n");
    const std::string function = std::string("native_render") + (packets ? "_packets" : "") + (twofold ? "_d" : "_f");
    out.code = run_callgrind("speed-worker", requests, function, folder);
    out.mix = executed_mix(out.code);
    return out;
}

} // namespace clucida::bench
