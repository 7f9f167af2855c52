#include "bench/reference.h"

#include "bench/precision_name.h"
#include "host/errors.h"
#include "host/fingerprint.h"
#include "host/picture_file.h"
#include "host/program_cache.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cerrno>

namespace clucida::bench {
namespace {

constexpr unsigned least_samples = 64, samples_factor = 4, hops_factor = 2;
constexpr unsigned most_samples = 1U << 20, most_hops = 1000000; ///< that a view may have
constexpr double cutoff_part = 16;

std::string fingerprint_of(const host::SceneSource& source, const SpeedSettings& settings, const SpeedView& view)
{
    host::CompiledFrame frame;
    frame.eyes.push_back(host::compile_scene(source, view_of(view)));
    const std::string what = host::Fingerprints().of(frame, settings.reference_precision, host::StereoLayout::none,
                                                     host::FileFormat::pfm, {});
    return fmt::format("{}-{}x{}-{}", what, view.picture.width, view.picture.height, view.samples);
}

std::filesystem::path folder_of_references(const std::filesystem::path& otherwise)
{
    const std::filesystem::path cache = host::cache_folder();
    std::error_code error;
    if (!cache.empty()) std::filesystem::create_directories(cache / "references", error);
    return cache.empty() || error ? otherwise : cache / "references";
}

bool is_whole(const std::filesystem::path& file, host::Shape size)
{
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return false;
    try {
        const host::Picture picture = host::read_picture(file);
        return picture.width == size.width && picture.height == size.height;
    } catch (const host::Failure&) {
        return false;
    }
}

} // namespace

SpeedView reference_view(const std::vector<SpeedContender>& contenders, host::Shape picture,
                         const host::SceneSource& source)
{
    SpeedView out{picture, least_samples / samples_factor};
    unsigned hops = 0;
    double cutoff = 1;
    for (const SpeedContender& c : contenders) {
        out.samples = std::max(out.samples, c.view.samples);
        hops = std::max(hops, c.view.max_hops.value_or(source.scene.settings.max_hops));
        cutoff = std::min(cutoff, c.view.cutoff.value_or(source.scene.settings.cutoff));
    }
    out.samples = std::min(samples_factor * out.samples, most_samples);
    out.max_hops = std::min(hops_factor * hops, most_hops);
    out.cutoff = cutoff / cutoff_part;
    return out;
}

std::filesystem::path reference_file(const host::SceneSource& source, const host::SceneOptions& scene,
                                     const SpeedSettings& settings, const SpeedView& view,
                                     const std::filesystem::path& folder)
{
    std::filesystem::path file = folder_of_references(folder) / (fingerprint_of(source, settings, view) + ".pfm");
    if (is_whole(file, view.picture)) return file;
    SpeedSettings one = settings;
    one.contenders = {{settings.reference_device, settings.reference_precision, 0, {}, {}, view}};
    std::vector<Seat> seats = make_seats(scene, one, folder / "reference");
    open_seat(seats, 0, settings.compiled);
    seats.front().worker->ask({{"do", "store"}, {"file", file.string()}});
    return file;
}

std::string describe_reference(const SpeedView& view, host::Precision precision)
{
    return fmt::format("{} samples a pixel, {} hops, a cutoff of {:.2g}, {}", view.samples, view.max_hops.value_or(0),
                       view.cutoff.value_or(0), precision_name(precision));
}

} // namespace clucida::bench
