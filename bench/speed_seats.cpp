#include "bench/speed_seats.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace clucida::bench {
namespace {

/// What limits a CPU device's threads, for whichever implementation it is: all read it once, as they start.
constexpr const char* thread_limits[] = {"POCL_MAX_PTHREAD_COUNT", "POCL_CPU_MAX_CU_COUNT", "LP_NUM_THREADS"};

Seat make_seat(const host::SceneOptions& scene, const SpeedSettings& settings, const SpeedContender& contender,
               const std::filesystem::path& folder)
{
    Seat out;
    out.task.scene = scene;
    out.task.contender = contender;
    out.task.native = settings.native;
    out.task.native.folder = folder;
    // Reports tell it: they are to hold no paths.
    out.name = fmt::format("{}, {}", std::filesystem::path(scene.file).filename().string(), describe(contender));
    out.most_opening = settings.most_opening;
    std::filesystem::create_directories(folder);
    out.environment = caches_in(folder);
    if (contender.threads)
        for (const char* limit : thread_limits) out.environment[limit] = std::to_string(contender.threads);
    return out;
}

std::unique_ptr<WorkerProcess> start(const Seat& seat)
{
    return std::make_unique<WorkerProcess>(seat.name, "speed-worker", seat.environment);
}

Readying open(WorkerProcess& worker, Seat& seat)
{
    nlohmann::json request = to_json(seat.task);
    request["do"] = "open";
    const nlohmann::json answer = worker.ask(request, seat.most_opening);
    SpeedReport& found = seat.found;
    found.what = answer.at("what");
    found.options = answer.at("options");
    found.kernel = answer.at("packets").get<bool>() ? host::KernelShape::packets : host::KernelShape::pixels;
    found.threads = answer.at("threads");
    found.objects = answer.at("objects");
    found.scene_bytes = answer.at("scene_bytes");
    return {answer.at("build"), answer.at("first_launch")};
}

const CompiledProgram* find(const CompiledPrograms& compiled, const std::string& scene, const SpeedContender& contender)
{
    const auto at = std::ranges::find_if(compiled.programs, [&](const CompiledProgram& p) {
        return p.scene == scene && same_program(p.contender, contender);
    });
    return at == compiled.programs.end() ? nullptr : &*at;
}

/// The program's, or a new one.
std::filesystem::path folder_of(CompiledPrograms& compiled, const std::string& scene, const SpeedContender& contender)
{
    const CompiledProgram* known = find(compiled, scene, contender);
    return known ? known->folder : compiled.folder / std::to_string(compiled.folders++);
}

} // namespace

host::Environment caches_in(const std::filesystem::path& folder)
{
    host::Environment out;
    for (const char* cache : {"POCL_CACHE_DIR", "XDG_CACHE_HOME", "MESA_SHADER_CACHE_DIR", "CUDA_CACHE_PATH"})
        out[cache] = folder.string();
    return out;
}

std::vector<Seat> make_seats(const host::SceneOptions& scene, const SpeedSettings& settings,
                             const std::filesystem::path& folder)
{
    std::vector<Seat> out;
    for (const SpeedContender& c : settings.contenders) {
        const auto sits = [&](const Seat& s) { return same_process(s.task.contender, c); };
        if (std::ranges::any_of(out, sits)) continue;
        const auto shares = [&](const Seat& s) { return same_program(s.task.contender, c); };
        const auto other = std::ranges::find_if(out, shares);
        std::filesystem::path own = folder / std::to_string(out.size());
        if (other != out.end())
            own = other->task.native.folder;
        else if (settings.compiled)
            own = folder_of(*settings.compiled, scene.file, c);
        out.push_back(make_seat(scene, settings, c, own));
    }
    return out;
}

Seat& seat_of(std::vector<Seat>& seats, const SpeedContender& contender)
{
    return *std::ranges::find_if(seats, [&](const Seat& s) { return same_process(s.task.contender, contender); });
}

void open_seat(std::vector<Seat>& seats, std::size_t which, CompiledPrograms* compiled)
{
    Seat& seat = seats[which];
    const SpeedContender& contender = seat.task.contender;
    const auto before = std::span(seats).first(which);
    const auto twin = std::ranges::find_if(
        before, [&](const Seat& s) { return s.failure.empty() && same_program(s.task.contender, contender); });
    const CompiledProgram* known = compiled ? find(*compiled, seat.task.scene.file, contender) : nullptr;
    if (twin != before.end())
        seat.found.cold = twin->found.cold;
    else if (known)
        seat.found.cold = known->cold;
    else
        seat.found.cold = open(*start(seat), seat);
    auto worker = start(seat);
    seat.found.cached = open(*worker, seat);
    seat.worker = std::move(worker);
    if (compiled && !known)
        compiled->programs.push_back({seat.task.scene.file, contender, seat.task.native.folder, seat.found.cold});
}

} // namespace clucida::bench
