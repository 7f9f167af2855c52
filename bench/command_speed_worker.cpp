#include "bench/commands.h"
#include "bench/median.h"
#include "bench/racer.h"
#include "bench/worker_process.h"
#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace clucida::bench {
namespace {

struct Worker {
    SpeedTask task;
    Racer racer;
    host::Picture picture; ///< the last
};

/// The most memory that this process held. The maximum that getrusage() tells begins with the parent's.
std::uint64_t peak_bytes()
{
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);) {
        std::istringstream words(line);
        std::string name;
        std::uint64_t kilobytes = 0;
        if (words >> name >> kilobytes && name == "VmHWM:") return kilobytes * 1024;
    }
    return 0;
}

/// Readies the contender: its program is compiled and, where code is generated as late as at the first launch, has run.
nlohmann::json open(Worker& w, const nlohmann::json& request)
{
    w.task = task_of(request);
    w.racer = make_racer(w.task);
    const host::Shape whole = w.task.picture;
    host::Shape part{};
    if (!is_native(w.task.contender)) part = {std::min(16U, whole.width), std::min(4U, whole.height)};
    const host::Frame frame = w.racer.render(part);
    return {{"build", frame.timings.build},
            {"first_launch", frame.timings.first_enqueue},
            {"what", w.racer.what},
            {"options", w.racer.options},
            {"threads", w.racer.threads}};
}

/// A turn: pictures for the time that was asked for, at least one; of which the median counts.
nlohmann::json turn(Worker& w, const nlohmann::json& request)
{
    if (!w.racer.render) throw host::UsageError("there is nothing to render yet");
    const double least = request.value("least_seconds", 0.0);
    std::vector<double> real, cpu;
    host::Frame frame;
    unsigned retries = 0;
    double sum = 0;
    do {
        frame = w.racer.render(w.task.picture);
        retries += frame.retries;
        real.push_back(frame.timings.trace);
        cpu.push_back(frame.timings.trace_cpu);
        sum += frame.timings.trace;
    } while (sum < least);
    w.picture = std::move(frame.picture);
    nlohmann::json statistics;
    for (const host::StatisticsField& f : host::statistics_fields()) statistics[f.name] = frame.statistics.*f.value;
    return {{"real", median(real)},
            {"cpu", median(cpu)},
            {"pictures", real.size()},
            {"retries", retries},
            {"statistics", statistics},
            {"peak_bytes", peak_bytes()},
            {"interior", frame.needs.interior},
            {"stack", frame.needs.stack}};
}

/// The last picture's pixels, by their numbers row by row.
nlohmann::json pixels(const Worker& w, const nlohmann::json& request)
{
    nlohmann::json rgb = nlohmann::json::array();
    for (const std::size_t i : request.at("pixels").get<std::vector<std::size_t>>())
        for (std::size_t k = 0; k < 3; ++k) rgb.push_back(w.picture.rgb.at(3 * i + k));
    return {{"rgb", std::move(rgb)}};
}

void run()
{
    Worker worker;
    serve([&](const nlohmann::json& request) {
        const std::string what = request.at("do").get<std::string>();
        if (what == "open") return open(worker, request);
        if (what == "turn") return turn(worker, request);
        if (what == "pixels") return pixels(worker, request);
        throw host::UsageError(fmt::format("'{}' is nothing that can be done; expected open, turn or pixels", what));
    });
}

} // namespace

void add_speed_worker(CLI::App& app)
{
    CLI::App* command = app.add_subcommand("speed-worker", "A contender of `speed`, told what to do by JSON in lines");
    command->group(""); // not for people
    command->callback(run);
}

} // namespace clucida::bench
