#include "bench/agreement_output.h"
#include "bench/commands.h"
#include "bench/worker_process.h"
#include "bench/write_json.h"
#include "host/arguments.h"
#include "host/atomic_file.h"
#include "host/commands.h"
#include "host/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <memory>
#include <optional>

namespace clucida::bench {
namespace {

struct AgreementOptions {
    std::vector<std::string> scenes, places, precisions{"float"}, kernels{"pixels"};
    std::string allow_path, size = "160x90", json;
    unsigned samples = 1;
    double seconds = 600;
    std::optional<double> most_flips;
    std::optional<unsigned> most_steps;
    bool quiet = false;
};

std::vector<Way> ways_of(const AgreementOptions& o)
{
    std::vector<Way> out;
    for (const std::string& precision : o.precisions)
        for (const std::string& kernel : o.kernels)
            out.push_back({precision == "double" ? host::Precision::twofold : host::Precision::single,
                           kernel == "packets" ? host::KernelShape::packets : host::KernelShape::pixels});
    return out;
}

/// A place at work: its process, anew after one that died.
struct Worker {
    Place place;
    std::unique_ptr<WorkerProcess> process = nullptr;
    std::map<host::Precision, std::vector<std::uint32_t>> paths = {}; ///< of the scene at hand
    std::map<Way, std::string> given_up = {};                         ///< what it took too long for: why
};

/// Whether there is a picture: else the device lacks the precision, or *out has the failure.
bool render(Worker& w, const std::string& scene, const Way& way, const AgreementOptions& o, SceneAgreement& out,
            Render& picture)
{
    const host::Shape size = host::parse_picture_size(o.size);
    const bool known = w.paths.contains(way.precision);
    if (const auto at = w.given_up.find(way); at != w.given_up.end()) {
        out.failure = at->second;
        return false;
    }
    try {
        if (!w.process)
            w.process = std::make_unique<WorkerProcess>(w.place.name, "agreement-worker", w.place.environment);
        const nlohmann::json answer = w.process->ask({{"scene", scene},
                                                      {"allow_path", o.allow_path},
                                                      {"width", size.width},
                                                      {"height", size.height},
                                                      {"samples", o.samples},
                                                      {"device", w.place.selector},
                                                      {"double", way.precision == host::Precision::twofold},
                                                      {"packets", way.kernel == host::KernelShape::packets},
                                                      {"paths", !known}},
                                                     o.seconds);
        out.device = answer.at("device").get<std::string>();
        if (!answer.contains("rgb")) return false;
        out.faults = answer.at("faults").get<std::string>();
        picture.rgb = answer.at("rgb").get<std::vector<std::uint32_t>>();
        if (!known) w.paths[way.precision] = answer.value("paths", std::vector<std::uint32_t>());
        picture.paths = w.paths[way.precision];
        return true;
    } catch (const host::Failure& e) {
        if (dynamic_cast<const TookTooLong*>(&e)) w.given_up[way] = e.what();
        w.process.reset();
        out.failure = e.what();
        return false;
    }
}

/// The scene on all places; the first is what the others are held against.
void measure(const std::string& scene, std::vector<Worker>& workers, const AgreementOptions& o,
             std::vector<SceneAgreement>& results)
{
    const host::Shape size = host::parse_picture_size(o.size);
    for (Worker& w : workers) w.paths.clear();
    for (const Way& way : ways_of(o)) {
        std::optional<Render> reference;
        for (Worker& w : workers) {
            if (!o.quiet) fmt::print(stderr, "{}: {}\n", scene, w.place.name);
            SceneAgreement result;
            result.scene = std::filesystem::path(scene).filename().string();
            result.place = w.place.name;
            result.way = way;
            Render picture;
            if (render(w, scene, way, o, result, picture)) {
                if (!reference) reference = picture;
                result.agreement = agree(*reference, picture, size);
            } else if (result.failure.empty()) {
                continue; // it lacks the precision
            }
            if (&w == &workers.front() && !result.failure.empty()) throw host::Failure(result.failure);
            results.push_back(std::move(result));
        }
    }
}

bool passes(const SceneAgreement& r, const AgreementOptions& o)
{
    return r.failure.empty() && r.faults.empty() &&
           (!o.most_flips || flips_per_million(r.agreement) <= *o.most_flips) &&
           (!o.most_steps || r.agreement.most_steps <= *o.most_steps);
}

void run(const AgreementOptions& o)
{
    const host::Shape size = host::parse_picture_size(o.size);
    if (!o.json.empty() && o.json != "-") host::require_writable(o.json);
    std::vector<Worker> workers;
    for (const std::string& place : o.places) workers.push_back({parse_place(place)});
    std::vector<SceneAgreement> results;
    for (const std::string& scene : o.scenes) measure(scene, workers, o, results);
    print_agreement(o.json == "-" ? stderr : stdout, results, size);
    if (!o.json.empty()) write_json(o.json, agreement_json(results, size));
    if (!o.most_flips && !o.most_steps) return;
    std::size_t failed = 0;
    for (const SceneAgreement& r : results) failed += !passes(r, o);
    if (failed)
        throw host::Failure(
            fmt::format("{} of {} pictures fail or are further apart than allowed", failed, results.size()));
}

} // namespace

void add_agreement(CLI::App& app)
{
    auto options = std::make_shared<AgreementOptions>();
    AgreementOptions& o = *options;
    CLI::App* command = app.add_subcommand("agreement", "Whether devices make the same pictures on the same paths");
    command->add_option("scenes", o.scenes, "scenes' files")->required()->option_text("SCENE...");
    command->add_option("--allow-path", o.allow_path, "photographs may also lie beneath this folder")
        ->option_text("FOLDER");
    command->add_option("-s,--size", o.size, "of the picture in pixels")->option_text("WxH")->capture_default_str();
    command->add_option("--samples", o.samples, "of each pixel")
        ->check(host::number_within(1, 1U << 20))
        ->option_text("N")
        ->capture_default_str();
    command
        ->add_option("--device", o.places,
                     "as for `clucida render`, after what its process's environment is to have: "
                     "\"RUSTICL_ENABLE=llvmpipe rusticl\"; again for another device. The first is the one that the "
                     "others are held against")
        ->required()
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->option_text("'[NAME=VALUE ...] WHICH'");
    command
        ->add_option("--seconds", o.seconds,
                     "that a device may take for a picture, compiling included; then its process is ended, and the "
                     "kernel and precision are tried on no further scene. 0: no end")
        ->check(host::number_within(0, 1e6))
        ->option_text("S")
        ->capture_default_str();
    command->add_option("--precision", o.precisions, "float, double: --precision float,double")
        ->delimiter(',')
        ->check(CLI::IsMember({"float", "double"}))
        ->option_text("NAME,...");
    command->add_option("--kernel", o.kernels, "pixels, packets: --kernel pixels,packets")
        ->delimiter(',')
        ->check(CLI::IsMember({"pixels", "packets"}))
        ->option_text("NAME,...");
    command->add_option("--fail-above-flips", o.most_flips, "exit with 1 if in a scene more paths of a million differ")
        ->option_text("N");
    command->add_option("--fail-above-steps", o.most_steps, "exit with 1 if a value differs by more 8-bit steps")
        ->option_text("N");
    command
        ->add_option("--json", o.json,
                     "also write a report in the shape of Google Benchmark's; -: to standard output, "
                     "and the table to standard error")
        ->option_text("FILE");
    command->add_flag("-q,--quiet", o.quiet, "print no progress");
    command->footer(
        "Examples:\n"
        "  clucida-bench agreement scene.clu --device pocl --device gpu\n"
        "  clucida-bench agreement scenes/*.clu --device pocl --device 'POCL_DEVICES=basic pocl' \\\n"
        "      --kernel pixels,packets --precision float,double --fail-above-flips 0\n"
        "\nscripts/portability runs it on all implementations for CPUs. docs/portability.md has its table.");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
