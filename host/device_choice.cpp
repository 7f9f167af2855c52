#include "host/device_choice.h"

#include "host/errors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>

namespace clucida::host {
namespace {

std::string lower(std::string_view s)
{
    std::string out(s);
    for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
}

std::string list(std::span<const DeviceInfo> devices, const std::vector<std::size_t>& which)
{
    std::string out;
    for (const std::size_t i : which)
        out += fmt::format("\n  {}{}", describe(devices[i]), devices[i].usable ? "" : " - not usable");
    return out;
}

std::vector<std::size_t> every(std::span<const DeviceInfo> devices)
{
    std::vector<std::size_t> out(devices.size());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = i;
    return out;
}

std::optional<std::size_t> first_of(std::span<const DeviceInfo> devices, DeviceKind kind)
{
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (devices[i].usable && !devices[i].native && devices[i].kind == kind) return i;
    return std::nullopt;
}

std::optional<std::size_t> find_native(std::span<const DeviceInfo> devices)
{
    for (std::size_t i = 0; i < devices.size(); ++i)
        if (devices[i].usable && devices[i].native) return i;
    return std::nullopt;
}

bool has_opencl(std::span<const DeviceInfo> devices)
{
    return std::ranges::any_of(devices, [](const DeviceInfo& d) { return d.usable && !d.native; });
}

struct PlatformDevice {
    unsigned platform, device;
};
std::optional<PlatformDevice> parse_pair(std::string_view s)
{
    const auto colon = s.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    PlatformDevice pair{};
    const auto number = [](std::string_view text, unsigned& to) {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), to);
        return error == std::errc() && end == text.data() + text.size();
    };
    if (!number(s.substr(0, colon), pair.platform) || !number(s.substr(colon + 1), pair.device)) return std::nullopt;
    return pair;
}

bool named(const DeviceInfo& d, const std::string& part)
{
    for (const std::string* text : {&d.platform_name, &d.platform_vendor, &d.name, &d.vendor})
        if (lower(*text).find(part) != std::string::npos) return true;
    return false;
}

/// Of one word, in small letters. @throws Failure
std::vector<std::size_t> choose_by_word(std::span<const DeviceInfo> devices, const std::string& word)
{
    const auto gpu = first_of(devices, DeviceKind::gpu), cpu = first_of(devices, DeviceKind::cpu),
               other = first_of(devices, DeviceKind::other);
    const auto native = find_native(devices);
    const auto one = [](const std::optional<std::size_t>& i) {
        return i ? std::vector{*i} : std::vector<std::size_t>{};
    };
    if (word.empty()) return one(gpu ? gpu : cpu ? cpu : other ? other : native);
    if (word == "gpu") return one(gpu);
    if (word == "cpu") return one(cpu ? cpu : native);
    if (word == "native") return one(native);
    const auto pair = parse_pair(word);
    std::vector<std::size_t> matches;
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& d = devices[i];
        if (d.usable && !d.native &&
            (word == "all" || (pair ? d.platform == pair->platform && d.device == pair->device : named(d, word))))
            matches.push_back(i);
    }
    if (word == "all" && matches.empty()) return one(native);
    if (matches.size() > 1 && word != "all")
        throw Failure(fmt::format("'{}' matches several OpenCL devices; name one by its number:{}", word,
                                  list(devices, matches)));
    return matches;
}

} // namespace

const char* kind_name(DeviceKind kind)
{
    switch (kind) {
    case DeviceKind::cpu: return "cpu";
    case DeviceKind::gpu: return "gpu";
    case DeviceKind::other: break;
    }
    return "other";
}

std::string place(const DeviceInfo& device)
{
    return device.native ? "native" : fmt::format("{}:{}", device.platform, device.device);
}

std::string describe(const DeviceInfo& device)
{
    if (device.native) return fmt::format("native {} (without OpenCL)", device.name);
    return fmt::format("{} {} ({})", place(device), device.name, device.platform_name);
}

std::vector<std::size_t> choose_devices(std::span<const DeviceInfo> devices, std::string_view selector)
{
    std::vector<std::size_t> out;
    for (std::size_t begin = 0; begin <= selector.size();) {
        const std::size_t end = std::min(selector.find(',', begin), selector.size());
        const std::string_view word = selector.substr(begin, end - begin);
        begin = end + 1;
        if (word.empty() && !selector.empty())
            throw UsageError(fmt::format("'{}' names no device between two commas", selector));
        const std::vector<std::size_t> chosen = choose_by_word(devices, lower(word));
        if (chosen.empty() && !has_opencl(devices))
            throw Failure(fmt::format("no OpenCL device is installed. On Debian or Ubuntu, `apt install "
                                      "pocl-opencl-icd` gives one for the processor; for a graphics card, install its "
                                      "maker's OpenCL driver{}",
                                      find_native(devices) ? "; --device native does without" : ""));
        if (chosen.empty())
            throw Failure(
                fmt::format("no OpenCL device matches '{}'. There is:{}", word, list(devices, every(devices))));
        for (const std::size_t i : chosen)
            if (std::ranges::find(out, i) == out.end()) out.push_back(i);
    }
    return out;
}

std::size_t choose_device(std::span<const DeviceInfo> devices, std::string_view selector)
{
    const auto chosen = choose_devices(devices, selector);
    if (chosen.size() > 1)
        throw UsageError(fmt::format("only one device will do here; choose one of:{}", list(devices, chosen)));
    return chosen.front();
}

void require_double(const DeviceInfo& device)
{
    if (!device.has_double)
        throw Failure(fmt::format("the device {} has no double precision; use --precision float or another --device",
                                  describe(device)));
}

} // namespace clucida::host
