#include "host/regions.h"

#include <algorithm>

namespace clucida::host {
namespace {

/// Between looks at whether another has taken longer than was to be expected.
constexpr std::chrono::milliseconds patience{20};

std::size_t count(unsigned side, unsigned step)
{
    return (std::size_t{side} + step - 1) / step;
}

} // namespace

Shape Region::visible(Shape picture) const
{
    return {std::min(shape.width, picture.width - x), std::min(shape.height, picture.height - y)};
}

bool Regions::Taken::is_taken_by(std::size_t taker) const
{
    return std::ranges::find(takers, taker) != takers.end();
}

Regions::Regions(Shape picture, Shape cell, std::vector<Taker> takers, unsigned most_rows)
    : picture_(picture), cell_(cell), columns_(count(picture.width, cell.width)),
      rows_(count(picture.height, cell.height)), takers_(std::move(takers)),
      most_cell_rows_(std::max(most_rows / cell.height, 1u))
{
    for (const Taker& t : takers_) speed_ += t.pixel_seconds > 0 ? 1 / t.pixel_seconds : 0;
}

double Regions::seconds_of(const Region& region, std::size_t taker) const
{
    return static_cast<double>(area(region.shape)) * takers_[taker].pixel_seconds;
}

/// Of several, half of its share of what is left at most.
std::size_t Regions::cells_of(std::size_t taker) const
{
    const Taker& t = takers_[taker];
    double cells = static_cast<double>(t.most_pixels) / static_cast<double>(area(cell_));
    if (takers_.size() > 1 && t.pixel_seconds > 0) {
        const double share = 1 / t.pixel_seconds / speed_;
        cells = std::min(cells, share / 2 * static_cast<double>(columns_ * rows_ - next_));
    }
    return std::max<std::size_t>(static_cast<std::size_t>(cells), 1);
}

std::optional<Region> Regions::carve(std::size_t taker)
{
    if (next_ == columns_ * rows_) return std::nullopt;
    const std::size_t cells = cells_of(taker), column = next_ % columns_, row = next_ / columns_;
    std::size_t width = columns_, height = 1;
    if (column == 0 && cells >= columns_) {
        height = std::min({cells / columns_, most_cell_rows_, rows_ - row});
    } else { // in equal parts, not with a little left over
        const std::size_t rest = columns_ - column, parts = (rest + cells - 1) / cells;
        width = (rest + parts - 1) / parts;
    }
    next_ += width * height;
    return Region{static_cast<unsigned>(column) * cell_.width,
                  static_cast<unsigned>(row) * cell_.height,
                  {static_cast<unsigned>(width) * cell_.width, static_cast<unsigned>(height) * cell_.height}};
}

/// A region of another that this taker would have done before it. A taker that is late by its whole time is held to be
/// stuck.
std::optional<Region> Regions::second(std::size_t taker)
{
    for (Taken& taken : taken_) {
        if (taken.is_taken_by(taker)) continue;
        const double passed = std::chrono::duration<double>(Clock::now() - taken.since).count();
        const double expected = seconds_of(taken.region, taken.takers.front());
        const bool sooner = seconds_of(taken.region, taker) < expected - passed;
        if (!sooner && passed < 2 * expected + 2 * std::chrono::duration<double>(patience).count()) continue;
        taken.takers.push_back(taker);
        return taken.region;
    }
    return std::nullopt;
}

std::optional<Region> Regions::take_locked(std::size_t taker)
{
    if (stopped_) return std::nullopt;
    std::optional<Region> region;
    if (returned_.empty()) {
        region = carve(taker);
        if (!region) return second(taker);
    } else {
        region = returned_.back();
        returned_.pop_back();
    }
    taken_.push_back({*region, {taker}, Clock::now()});
    return region;
}

std::optional<Region> Regions::take(std::size_t taker)
{
    const std::lock_guard lock(mutex_);
    return take_locked(taker);
}

std::optional<Region> Regions::wait_and_take(std::size_t taker)
{
    std::unique_lock lock(mutex_);
    for (;;) {
        if (auto region = take_locked(taker)) return region;
        if (stopped_ || is_complete_locked()) return std::nullopt;
        changed_.wait_for(lock, patience);
    }
}

bool Regions::is_complete_locked() const
{
    return taken_.empty() && returned_.empty() && next_ == columns_ * rows_;
}

bool Regions::is_complete()
{
    const std::lock_guard lock(mutex_);
    return is_complete_locked();
}

bool Regions::finish(const Region& region)
{
    const std::lock_guard lock(mutex_);
    const bool first = std::erase_if(taken_, [&](const Taken& t) { return t.region == region; }) > 0;
    changed_.notify_all();
    return first;
}

void Regions::give_back(std::size_t taker)
{
    const std::lock_guard lock(mutex_);
    if (takers_[taker].pixel_seconds > 0) speed_ -= 1 / takers_[taker].pixel_seconds;
    for (Taken& taken : taken_) {
        std::erase(taken.takers, taker);
        if (taken.takers.empty()) returned_.push_back(taken.region);
    }
    std::erase_if(taken_, [](const Taken& t) { return t.takers.empty(); });
    changed_.notify_all();
}

void Regions::stop()
{
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    changed_.notify_all();
}

} // namespace clucida::host
