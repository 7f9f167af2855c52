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
        if (devices[i].usable && devices[i].kind == kind) return i;
    return std::nullopt;
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

} // namespace

std::string describe(const DeviceInfo& device)
{
    return fmt::format("{}:{} {} ({})", device.platform, device.device, device.name, device.platform_name);
}

std::vector<std::size_t> choose_devices(std::span<const DeviceInfo> devices, std::string_view selector)
{
    if (std::none_of(devices.begin(), devices.end(), [](const DeviceInfo& d) { return d.usable; }))
        throw Failure("no OpenCL device is installed. On Debian or Ubuntu, `apt install pocl-opencl-icd` gives one for "
                      "the processor; for a graphics card, install its maker's OpenCL driver");

    const std::string word = lower(selector);
    std::vector<std::size_t> matches;
    if (word.empty()) {
        const auto gpu = first_of(devices, DeviceKind::gpu);
        const auto cpu = first_of(devices, DeviceKind::cpu);
        return {gpu ? *gpu : cpu ? *cpu : first_of(devices, DeviceKind::other).value()};
    }
    if (word == "cpu" || word == "gpu") {
        const auto found = first_of(devices, word == "cpu" ? DeviceKind::cpu : DeviceKind::gpu);
        if (found) matches = {*found};
    } else {
        const auto pair = parse_pair(word);
        for (std::size_t i = 0; i < devices.size(); ++i) {
            const DeviceInfo& d = devices[i];
            if (d.usable &&
                (word == "all" || (pair ? d.platform == pair->platform && d.device == pair->device : named(d, word))))
                matches.push_back(i);
        }
    }
    if (matches.empty())
        throw Failure(
            fmt::format("no OpenCL device matches '{}'. There is:{}", selector, list(devices, every(devices))));
    if (matches.size() > 1 && word != "all")
        throw Failure(fmt::format("'{}' matches several OpenCL devices; name one by its number:{}", selector,
                                  list(devices, matches)));
    return matches;
}

std::size_t choose_device(std::span<const DeviceInfo> devices, std::string_view selector)
{
    const auto chosen = choose_devices(devices, selector);
    if (chosen.size() > 1)
        throw UsageError(fmt::format("one picture on several devices at once is not supported yet; choose one of:{}",
                                     list(devices, chosen)));
    return chosen.front();
}

void require_double(const DeviceInfo& device)
{
    if (!device.has_double)
        throw Failure(fmt::format("the device {} has no double precision; use --precision float or another --device",
                                  describe(device)));
}

} // namespace clucida::host
