#include "host/frames.h"

#include "host/errors.h"
#include "scene/limits.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <unordered_set>

namespace clucida::host {
namespace {

using scene::limits::frames;

std::optional<unsigned> whole_number(std::string_view text)
{
    unsigned value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

[[noreturn]] void wrong(std::string_view part, std::string_view why)
{
    throw UsageError(fmt::format("--frames: '{}' {}; expected a list such as 1-10,20-100x5,7", part, why));
}

unsigned frame_of(std::string_view text, std::string_view part)
{
    const auto frame = whole_number(text);
    if (!frame) wrong(part, fmt::format("has '{}' where a frame's number belongs", text));
    if (*frame < 1 || *frame > frames) wrong(part, fmt::format("is not within 1 and {}", frames));
    return *frame;
}

struct Range {
    unsigned first = 1, last = 1, step = 1;
};

Range parse_range(std::string_view part)
{
    Range range;
    std::string_view ends = part;
    if (const auto x = part.find('x'); x != std::string_view::npos) {
        const auto step = whole_number(part.substr(x + 1));
        if (!step || *step == 0) wrong(part, "has no step above 0 behind its x");
        range.step = *step;
        ends = part.substr(0, x);
    }
    const std::string_view between = ends.find("..") != std::string_view::npos ? ".." : "-";
    const auto dash = ends.find(between);
    range.first = frame_of(ends.substr(0, dash), part);
    range.last = dash == std::string_view::npos ? range.first : frame_of(ends.substr(dash + between.size()), part);
    return range;
}

} // namespace

std::vector<unsigned> parse_frames(std::string_view list, unsigned* repeated)
{
    std::vector<unsigned> out;
    std::unordered_set<unsigned> known;
    unsigned again = 0;
    for (std::string_view rest = list;;) {
        const auto comma = rest.find(',');
        const std::string_view part = rest.substr(0, comma);
        if (part.empty()) wrong(list, list.empty() ? "names no frame" : "has an empty part");
        const Range range = parse_range(part);
        const bool up = range.first <= range.last;
        for (long frame = range.first; up ? frame <= range.last : frame >= long{range.last};
             frame += up ? long{range.step} : -long{range.step}) {
            if (known.insert(static_cast<unsigned>(frame)).second)
                out.push_back(static_cast<unsigned>(frame));
            else
                ++again;
        }
        if (comma == std::string_view::npos) break;
        rest.remove_prefix(comma + 1);
    }
    if (repeated) *repeated = again;
    return out;
}

Shard parse_shard(std::string_view text)
{
    const auto slash = text.find('/');
    const auto index = whole_number(text.substr(0, slash));
    const auto count = slash == std::string_view::npos ? std::nullopt : whole_number(text.substr(slash + 1));
    if (!index || !count || *index < 1 || *index > *count)
        throw UsageError(fmt::format("--shard: '{}' is no I/N with I within 1 and N", text));
    return {*index, *count};
}

std::vector<unsigned> shard_of(const std::vector<unsigned>& all, Shard shard)
{
    std::vector<unsigned> out;
    for (std::size_t i = shard.index - 1; i < all.size(); i += shard.count) out.push_back(all[i]);
    return out;
}

FramePattern::FramePattern(const std::string& pattern)
{
    constexpr int most_digits = 18;
    std::string* text = &before_;
    const auto number = [&](long digits) {
        if (width_ >= 0) throw UsageError(fmt::format("'{}' has more than one place for the frame's number", pattern));
        if (digits > most_digits) throw UsageError(fmt::format("'{}' asks for {} digits", pattern, digits));
        width_ = static_cast<int>(digits);
        text = &after_;
    };
    for (std::size_t i = 0; i < pattern.size();) {
        if (pattern[i] == '#') {
            const std::size_t end = std::min(pattern.find_first_not_of('#', i), pattern.size());
            number(static_cast<long>(end - i));
            i = end;
        } else if (pattern.compare(i, 2, "%%") == 0) {
            *text += '%';
            i += 2;
        } else if (pattern[i] == '%') {
            const std::size_t end = pattern.find_first_not_of("0123456789", i + 1);
            if (end == std::string::npos || pattern[end] != 'd')
                throw UsageError(
                    fmt::format("'{}' has a '%' that is no %d or %04d; write %% for the sign itself", pattern));
            const std::string digits = pattern.substr(i + 1, end - i - 1);
            if (!digits.empty() && digits[0] != '0')
                throw UsageError(fmt::format("'{}' pads with blanks; write %0{}d", pattern, digits));
            number(digits.empty() ? 0 : long{whole_number(digits).value_or(most_digits + 1)});
            i = end + 1;
        } else {
            *text += pattern[i++];
        }
    }
}

std::string FramePattern::file(unsigned frame) const
{
    return width_ < 0 ? before_ : fmt::format("{}{:0{}}{}", before_, frame, width_, after_);
}

} // namespace clucida::host
