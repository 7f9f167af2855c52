#include "host/arguments.h"

#include "host/errors.h"

#include <fmt/format.h>

#include <charconv>

namespace clucida::host {
namespace {

constexpr unsigned most_side = 65536;
constexpr std::size_t most_pixels = std::size_t{1} << 30;

} // namespace

Shape parse_size(std::string_view text, const std::string& what)
{
    Shape out;
    const char* const end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, out.width);
    if (width.ec == std::errc() && width.ptr != end && (*width.ptr == 'x' || *width.ptr == 'X')) {
        const auto height = std::from_chars(width.ptr + 1, end, out.height);
        if (height.ec == std::errc() && height.ptr == end && out.width > 0 && out.height > 0) return out;
    }
    throw UsageError(
        fmt::format("{} '{}' is wrong: expected width x height in whole numbers from 1, such as 1280x720", what, text));
}

Shape parse_picture_size(std::string_view text)
{
    const Shape size = parse_size(text, "the picture's size");
    if (size.width > most_side || size.height > most_side || area(size) > most_pixels)
        throw UsageError(fmt::format("the picture's size {} is too large: at most {} pixels a side and {} in all", text,
                                     most_side, most_pixels));
    return size;
}

} // namespace clucida::host
