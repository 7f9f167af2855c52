#include "bench/commands.h"
#include "bench/median.h"
#include "bench/racer.h"
#include "bench/worker_process.h"
#include "host/atomic_file.h"
#include "host/compare.h"
#include "host/errors.h"
#include "host/picture_file.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

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
    const host::Shape whole = w.task.contender.view.picture;
    host::Shape part{};
    if (!is_native(w.task.contender)) part = {std::min(16U, whole.width), std::min(4U, whole.height)};
    const host::Frame frame = w.racer.render(w.task.contender.view, part);
    return {{"build", frame.timings.build},
            {"first_launch", frame.timings.first_enqueue},
            {"what", w.racer.what},
            {"options", scene::build_options(frame.needs)},
            {"packets", frame.kernel == host::KernelShape::packets},
            {"threads", w.racer.threads},
            {"objects", w.racer.objects},
            {"scene_bytes", w.racer.scene_bytes}};
}

const Racer& racer_of(const Worker& w)
{
    if (!w.racer.render) throw host::UsageError("there is nothing to render yet");
    return w.racer;
}

/// A turn: pictures for the time that was asked for, at least one; of which the median counts.
nlohmann::json turn(Worker& w, const nlohmann::json& request)
{
    const Racer& racer = racer_of(w);
    const SpeedView view = speed_view_of(request, w.task.contender.view);
    const double least = request.value("least_seconds", 0.0);
    std::vector<double> real, cpu, kernels;
    host::Frame frame;
    unsigned retries = 0;
    double sum = 0;
    do {
        frame = racer.render(view, view.picture);
        retries += frame.retries;
        real.push_back(frame.timings.trace);
        cpu.push_back(frame.timings.trace_cpu);
        kernels.push_back(frame.timings.kernels);
        sum += frame.timings.trace;
    } while (sum < least);
    w.picture = std::move(frame.picture);
    nlohmann::json statistics;
    for (const host::StatisticsField& f : host::statistics_fields()) statistics[f.name] = frame.statistics.*f.value;
    return {{"real", median(real)},       {"cpu", median(cpu)},
            {"kernels", median(kernels)}, {"pictures", real.size()},
            {"retries", retries},         {"statistics", statistics},
            {"peak_bytes", peak_bytes()}, {"interior", frame.needs.interior},
            {"stack", frame.needs.stack}};
}

/// How far the last picture is from one in a file.
nlohmann::json error(const Worker& w, const nlohmann::json& request)
{
    const host::Picture truth = host::read_picture(request.at("reference").get<std::string>());
    const host::Comparison c = host::compare(w.picture, truth, 0);
    return {{"pixels", c.pixels},
            {"rmse", c.rmse},
            {"p999", c.p999},
            {"max_error", c.max_error},
            {"not_numbers", c.not_numbers}};
}

/// Renders a picture into a file, in launches that no device takes for a hang.
nlohmann::json store(const Worker& w, const nlohmann::json& request)
{
    const host::Frame frame = racer_of(w).render(speed_view_of(request, w.task.contender.view), std::nullopt);
    host::write_file(request.at("file").get<std::string>(), host::encode(frame.picture, host::FileFormat::pfm));
    return {{"seconds", frame.timings.trace}};
}

/// The last picture's pixels, by their numbers row by row.
nlohmann::json pixels(const Worker& w, const nlohmann::json& request)
{
    nlohmann::json rgb = nlohmann::json::array();
    for (const std::size_t i : request.at("pixels").get<std::vector<std::size_t>>())
        for (std::size_t k = 0; k < 3; ++k) rgb.push_back(w.picture.rgb.at(3 * i + k));
    return {{"rgb", std::move(rgb)}};
}

/// An implementation's compiler may want more memory than there is, and would take all else on this computer with it.
void limit_memory()
{
    const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGESIZE);
    if (pages <= 0 || bytes <= 0) return;
    rlimit limit{};
    if (::getrlimit(RLIMIT_DATA, &limit) != 0) return;
    limit.rlim_cur = std::min(limit.rlim_cur, static_cast<rlim_t>(pages) / 2 * static_cast<rlim_t>(bytes));
    ::setrlimit(RLIMIT_DATA, &limit);
}

void run()
{
    limit_memory();
    Worker worker;
    serve([&](const nlohmann::json& request) {
        const std::string what = request.at("do").get<std::string>();
        if (what == "open") return open(worker, request);
        if (what == "turn") return turn(worker, request);
        if (what == "pixels") return pixels(worker, request);
        if (what == "error") return error(worker, request);
        if (what == "store") return store(worker, request);
        throw host::UsageError(
            fmt::format("'{}' is nothing that can be done; expected open, turn, pixels, error or store", what));
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
