#include "bench/measure_speed.h"

#include "bench/median.h"
#include "bench/reference.h"
#include "bench/speed_error.h"
#include "bench/speed_seats.h"
#include "bench/spread.h"
#include "bench/temporary_folder.h"
#include "host/errors.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace clucida::bench {
namespace {

nlohmann::json request(const char* what, const SpeedView& view)
{
    nlohmann::json out = to_json(view);
    out["do"] = what;
    return out;
}

nlohmann::json take_turn(WorkerProcess& worker, const SpeedView& view, double least_seconds)
{
    nlohmann::json asked = request("turn", view);
    asked["least_seconds"] = least_seconds;
    return worker.ask(asked);
}

void note_turn(const nlohmann::json& turn, SpeedReport& report)
{
    report.real.push_back(turn.at("real"));
    report.cpu.push_back(turn.at("cpu"));
    report.kernels.push_back(turn.at("kernels"));
    report.pictures += turn.at("pictures").get<std::size_t>();
    for (const host::StatisticsField& f : host::statistics_fields())
        report.statistics.*f.value = turn.at("statistics").at(f.name);
    report.peak_bytes = turn.at("peak_bytes");
}

/// JSON has no infinities and no NaN.
double number_or(const nlohmann::json& j, double otherwise)
{
    return j.is_number() ? j.get<double>() : otherwise;
}

host::Picture ask_pixels(WorkerProcess& worker, const std::vector<std::size_t>& pixels)
{
    const nlohmann::json answer = worker.ask({{"do", "pixels"}, {"pixels", pixels}});
    host::Picture out = host::make_picture(static_cast<unsigned>(pixels.size()), 1);
    const nlohmann::json& rgb = answer.at("rgb");
    for (std::size_t i = 0; i < out.rgb.size(); ++i)
        out.rgb[i] = static_cast<float>(number_or(rgb.at(i), std::nan("")));
    return out;
}

host::Comparison ask_error(WorkerProcess& worker, const std::filesystem::path& reference)
{
    const nlohmann::json answer = worker.ask({{"do", "error"}, {"reference", reference.string()}});
    constexpr double infinite = std::numeric_limits<double>::infinity();
    host::Comparison out;
    out.pixels = answer.at("pixels");
    out.rmse = number_or(answer.at("rmse"), infinite);
    out.p999 = number_or(answer.at("p999"), infinite);
    out.max_error = number_or(answer.at("max_error"), infinite);
    out.not_numbers = answer.at("not_numbers");
    return out;
}

/// What pictures are held against, made when it is first asked for.
class Truths {
public:
    Truths(const host::SceneOptions& scene, const host::SceneSource& source, const SpeedSettings& settings,
           std::filesystem::path folder)
        : scene_(scene), source_(source), settings_(settings), folder_(std::move(folder))
    {
    }

    /// The pixels of that view as they should be.
    const host::Picture& pixels(const SpeedView& view, const std::vector<std::size_t>& which)
    {
        for (const auto& [of, picture] : pixels_)
            if (of == view) return picture;
        return pixels_.emplace_back(view, make_pixels(view, which)).second;
    }
    /// The reference for pictures of that size.
    const std::filesystem::path& file(host::Shape size)
    {
        for (const auto& [of, file] : files_)
            if (of == size) return file;
        const SpeedView view = reference_view(settings_.contenders, size, source_);
        return files_.emplace_back(size, reference_file(source_, scene_, settings_, view, folder_)).second;
    }

private:
    host::Picture make_pixels(const SpeedView& view, const std::vector<std::size_t>& which)
    {
        if (settings_.error == ErrorFrom::oracle)
            return true_pixels(source_, view_of(view), which, settings_.oracle_threads);
        if (seats_.empty()) {
            SpeedSettings one = settings_;
            one.contenders = {{settings_.reference_device, host::Precision::twofold, 0, {}, {}, view}};
            seats_ = make_seats(scene_, one, folder_ / "double");
            open_seat(seats_, 0, settings_.compiled);
        }
        WorkerProcess& worker = *seats_.front().worker;
        take_turn(worker, view, 0);
        return ask_pixels(worker, which);
    }

    const host::SceneOptions& scene_;
    const host::SceneSource& source_;
    const SpeedSettings& settings_;
    std::filesystem::path folder_;
    std::vector<std::pair<SpeedView, host::Picture>> pixels_;
    std::vector<std::pair<host::Shape, std::filesystem::path>> files_;
    std::vector<Seat> seats_; ///< of the double kernel; or none
};

/// The contenders of one scene, with all that they need to race.
class Race {
public:
    Race(const host::SceneOptions& scene, const SpeedSettings& settings, const std::function<void(double)>& progress)
        : settings_(settings), progress_(progress), source_(host::load_scene(scene)),
          seats_(make_seats(scene, settings, folder_.path())), truths_(scene, source_, settings, folder_.path())
    {
        out_.name = source_.name;
        out_.file = scene.file;
        out_.hash = source_.hash;
        steps_ = seats_.size() * 2 + settings.contenders.size() * (settings.rounds + 1);
    }

    SceneSpeed run()
    {
        open();
        warm_up();
        spent_.resize(out_.reports.size());
        for (unsigned round = 0; round < settings_.rounds; ++round) take_round(round);
        tell_ratios();
        if (settings_.settings_error && !out_.reports.empty()) {
            const SpeedView view =
                reference_view(settings_.contenders, settings_.contenders.front().view.picture, source_);
            out_.reference = describe_reference(view, settings_.reference_precision);
        }
        return std::move(out_);
    }

private:
    void advance(std::size_t steps = 1)
    {
        done_ += steps;
        progress_(static_cast<double>(done_) / static_cast<double>(steps_));
    }

    /// A contender's failure is its own, if so wanted.
    template <class Work>
    void attempt(Seat& seat, const Work& work)
    {
        if (!seat.failure.empty()) return;
        if (!settings_.keep_going) return work();
        try {
            work();
        } catch (const host::Failure& e) {
            seat.failure = e.what();
            seat.worker.reset();
        }
    }

    void open()
    {
        for (std::size_t i = 0; i < seats_.size(); ++i, advance(2))
            attempt(seats_[i], [&] { open_seat(seats_, i, settings_.compiled); });
        for (const SpeedContender& c : settings_.contenders) {
            out_.reports.push_back(seat_of(seats_, c).found);
            out_.reports.back().contender = c;
        }
    }

    /// Warms caches and clocks, and capacities come to suffice. The pictures are held against what is right.
    void warm_up()
    {
        for (SpeedReport& r : out_.reports) {
            Seat& seat = seat_of(seats_, r.contender);
            attempt(seat, [&] {
                take_turn(*seat.worker, r.contender.view, settings_.least_turn);
                tell_errors(*seat.worker, r);
            });
            advance();
        }
    }

    void tell_errors(WorkerProcess& worker, SpeedReport& r)
    {
        const SpeedView& view = r.contender.view;
        if (settings_.error != ErrorFrom::none) {
            const std::vector<std::size_t> which = grid_pixels(view.picture, settings_.error_pixels);
            r.arithmetic = host::compare(ask_pixels(worker, which), truths_.pixels(view, which), 0);
            out_.compared_pixels = which.size();
        }
        if (settings_.settings_error) r.settings = ask_error(worker, truths_.file(view.picture));
    }

    void take_round(unsigned round)
    {
        const std::size_t count = out_.reports.size();
        for (std::size_t turn = 0; turn < count; ++turn, advance()) {
            const std::size_t i = (round + turn) % count; // nobody always comes first, nor always after the same
            const bool enough = settings_.most_seconds > 0 && spent_[i] > settings_.most_seconds;
            if (enough && round >= settings_.least_rounds) continue;
            SpeedReport& r = out_.reports[i];
            Seat& seat = seat_of(seats_, r.contender);
            attempt(seat, [&] {
                note_turn(take_turn(*seat.worker, r.contender.view, settings_.least_turn), r);
                spent_[i] += std::max(r.real.back(), settings_.least_turn);
            });
        }
    }

    /// A contender that failed has no figures at all.
    void tell_ratios()
    {
        for (SpeedReport& r : out_.reports) {
            r.failure = seat_of(seats_, r.contender).failure;
            if (r.failure.empty()) continue;
            r.real.clear();
            r.cpu.clear();
        }
        const auto runs = [](const SpeedReport& r) { return r.failure.empty(); };
        const auto first = std::ranges::find_if(out_.reports, runs);
        for (SpeedReport& r : out_.reports) {
            if (!runs(r)) continue;
            const std::vector<double> real = ratios(r.real, first->real);
            r.ratio = median(real);
            r.ratio_spread = interquartile_range(real);
            r.cpu_ratio = median(ratios(r.cpu, first->cpu));
        }
    }

    /// Of the rounds that both took part in.
    static std::vector<double> ratios(const std::vector<double>& of, const std::vector<double>& to)
    {
        std::vector<double> out;
        for (std::size_t i = 0; i < std::min(of.size(), to.size()); ++i) out.push_back(of[i] / to[i]);
        return out;
    }

    const SpeedSettings& settings_;
    const std::function<void(double)>& progress_;
    host::SceneSource source_; // what is wrong with it is told before any work
    TemporaryFolder folder_;
    std::vector<Seat> seats_;
    Truths truths_;
    SceneSpeed out_;
    std::vector<double> spent_; ///< s, by each contender
    std::size_t steps_ = 0, done_ = 0;
};

} // namespace

std::string describe(const SpeedContender& c)
{
    std::string out = fmt::format("{} {}", is_native(c) ? "native-build" : c.device,
                                  c.precision == host::Precision::twofold ? "double" : "float");
    if (c.threads) out += fmt::format(", {} thread{}", c.threads, c.threads == 1 ? "" : "s");
    return out;
}

SceneSpeed measure_speed(const host::SceneOptions& scene, const SpeedSettings& settings,
                         const std::function<void(double)>& progress)
{
    return Race(scene, settings, progress).run();
}

} // namespace clucida::bench
