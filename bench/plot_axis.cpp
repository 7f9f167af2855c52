#include "bench/plot_axis.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace clucida::bench {
namespace {

constexpr std::size_t few_ticks = 3; ///< with fewer all that are fine get a number, if they are not too many
constexpr std::size_t most_ticks = 6;
constexpr double few_decades = 1.5; ///< up to which 2 and 5 get a number too

} // namespace

double nice_step(double span, unsigned most_parts)
{
    const double power = std::pow(10, std::floor(std::log10(span / most_parts)));
    for (const double factor : {1.0, 2.0, 5.0})
        if (span <= factor * power * most_parts * (1 + 1e-9)) return factor * power;
    return 10 * power;
}

std::string tick_text(double value)
{
    const double size = std::fabs(value);
    if (size >= 1e6) return fmt::format("{:g}M", value * 1e-6);
    if (size >= 1e4) return fmt::format("{:g}k", value * 1e-3);
    return fmt::format("{:g}", value);
}

AxisRange::AxisRange(Scale scale, const std::vector<double>& values) : scale_(scale)
{
    const double least = values.empty() ? 1 : *std::ranges::min_element(values);
    const double most = values.empty() ? 10 : *std::ranges::max_element(values);
    if (scale == Scale::linear)
        choose_linear(least, most);
    else
        choose_logarithmic(least, most);
    const auto is_whole = [](double value) { return std::floor(value) == value; };
    if (std::ranges::all_of(values, is_whole)) // of what is counted there are no parts
        for (auto* const some : {&ticks_, &fine_})
            if (std::ranges::any_of(*some, is_whole))
                std::erase_if(*some, [&](double tick) { return !is_whole(tick); });
}

void AxisRange::choose_linear(double least, double most)
{
    if (most <= least) most = least + std::max(std::fabs(least), 1.0);
    const double step = nice_step(most - least, most_ticks);
    begin_ = std::floor(least / step + 1e-9) * step;
    end_ = std::ceil(most / step - 1e-9) * step;
    const auto count = static_cast<unsigned>(std::lround((end_ - begin_) / step));
    for (unsigned i = 0; i <= count; ++i) ticks_.push_back(begin_ + i * step);
    for (double& tick : ticks_)
        if (std::fabs(tick) < 1e-9 * step) tick = 0;
}

void AxisRange::choose_logarithmic(double least, double most)
{
    constexpr double air = 1.15;
    begin_ = least / air;
    end_ = most * air;
    const int low = static_cast<int>(std::floor(std::log10(begin_))), high = static_cast<int>(std::log10(end_)) + 1;
    const double decades = std::log10(end_ / begin_);
    const int skip = std::max(1, static_cast<int>(std::ceil(decades / most_ticks)));
    for (int power = low; power <= high; ++power)
        for (const int factor : {1, 2, 3, 4, 5, 6, 7, 8, 9}) {
            const double value = factor * std::pow(10, power);
            if (value < begin_ || value > end_) continue;
            const bool is_named =
                factor == 1 ? power % skip == 0 : decades <= few_decades && (factor == 2 || factor == 5);
            (is_named ? ticks_ : fine_).push_back(value);
        }
    if (ticks_.size() < few_ticks && ticks_.size() + fine_.size() <= most_ticks) {
        ticks_.insert(ticks_.end(), fine_.begin(), fine_.end());
        std::ranges::sort(ticks_);
        fine_.clear();
    }
    if (ticks_.empty()) ticks_ = {least, most};
    if (ticks_.back() == ticks_.front()) ticks_.resize(1);
}

double AxisRange::place(double value) const
{
    if (scale_ == Scale::linear) return (value - begin_) / (end_ - begin_);
    return std::log(value / begin_) / std::log(end_ / begin_);
}

} // namespace clucida::bench
