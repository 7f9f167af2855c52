#include "host/calibration.h"

#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/program_cache.h"
#include "host/sha256.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace clucida::host {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format_name = "clucida calibration 1";

Json to_json(const CalibrationRecord& r)
{
    const QualitySettings& s = r.settings;
    return {{"scene", r.scene},
            {"sha256", r.hash},
            {"kernel", r.kernel},
            {"width", r.picture.width},
            {"height", r.picture.height},
            {"precision", s.precision == Precision::twofold ? "double" : "float"},
            {"samples", s.samples},
            {"max_hops", s.max_hops ? Json(*s.max_hops) : nullptr},
            {"cutoff", s.cutoff ? Json(*s.cutoff) : nullptr},
            {"seconds_per_pixel", r.seconds_per_pixel},
            {"rmse", r.rmse},
            {"p999", r.p999},
            {"max_error", r.max_error}};
}

CalibrationRecord record_of(const Json& j)
{
    CalibrationRecord r;
    r.scene = j.at("scene");
    r.hash = j.at("sha256");
    r.kernel = j.at("kernel");
    r.picture = {j.at("width"), j.at("height")};
    const auto precision = j.at("precision").get<std::string>();
    if (precision != "float" && precision != "double") throw Failure("the precision '" + precision + "'");
    r.settings.precision = precision == "double" ? Precision::twofold : Precision::single;
    r.settings.samples = j.at("samples");
    if (!j.at("max_hops").is_null()) r.settings.max_hops = j.at("max_hops").get<unsigned>();
    if (!j.at("cutoff").is_null()) r.settings.cutoff = j.at("cutoff").get<double>();
    r.seconds_per_pixel = j.at("seconds_per_pixel");
    r.rmse = j.at("rmse");
    r.p999 = j.at("p999");
    r.max_error = j.at("max_error");
    return r;
}

std::vector<CalibrationRecord> read_records(const std::filesystem::path& file)
{
    const Json j = Json::parse(read_file(file));
    if (j.at("format") != format_name) throw Failure("another format");
    std::vector<CalibrationRecord> out;
    for (const Json& record : j.at("records")) out.push_back(record_of(record));
    return out;
}

bool is_replaced_by(const CalibrationRecord& old, const CalibrationRecord& r)
{
    return old.hash == r.hash && old.kernel == r.kernel && old.picture == r.picture && old.settings == r.settings;
}

} // namespace

std::filesystem::path calibration_file(const DeviceInfo& device)
{
    const std::filesystem::path cache = cache_folder();
    if (cache.empty()) return {};
    std::string key = CLUCIDA_VERSION "\n";
    for (const std::string* part : {&device.name, &device.driver, &device.platform_version})
        key += fmt::format("{}\n{}\n", part->size(), *part);
    return cache / "calibration" / (sha256(key) + ".json");
}

std::vector<CalibrationRecord> load_calibration(const DeviceInfo& device, std::string* problem)
{
    const std::filesystem::path file = calibration_file(device);
    std::error_code error;
    if (file.empty() || !std::filesystem::exists(file, error)) return {};
    try {
        return read_records(file);
    } catch (const std::exception& e) { // of JSON, of the file, of what is in it
        if (problem) *problem = fmt::format("{} is broken and of no use: {}", file.string(), e.what());
        return {};
    }
}

void store_calibration(const DeviceInfo& device, const std::vector<CalibrationRecord>& records)
{
    const std::filesystem::path file = calibration_file(device);
    if (file.empty()) throw Failure("there is no home for a calibration: set HOME or XDG_CACHE_HOME");
    std::vector<CalibrationRecord> all = load_calibration(device);
    for (const CalibrationRecord& r : records) {
        std::erase_if(all, [&](const CalibrationRecord& old) { return is_replaced_by(old, r); });
        all.push_back(r);
    }
    Json j = {{"format", format_name},
              {"device", describe(device)},
              {"driver", device.driver},
              {"platform_version", device.platform_version},
              {"program_version", CLUCIDA_VERSION},
              {"records", Json::array()}};
    for (const CalibrationRecord& r : all) j["records"].push_back(to_json(r));
    std::error_code error;
    std::filesystem::create_directories(file.parent_path(), error);
    if (error)
        throw Failure(fmt::format("cannot make the folder {}: {}", file.parent_path().string(), error.message()));
    write_file(file, j.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
}

} // namespace clucida::host
