#include "host/program_cache.h"

#include "host/atomic_file.h"
#include "host/errors.h"
#include "host/sha256.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string_view>

namespace clucida::host {
namespace {

/// The implementations that keep compiled programs themselves. The only place where implementations have names.
constexpr std::array<std::string_view, 3> platforms_with_a_cache = {"Portable Computing Language", "NVIDIA CUDA",
                                                                    "rusticl"};

constexpr std::string_view magic = "clucida kernel 1\n";

/// magic, digest of the key, digest of the program, the program
std::string header_of(const std::string& key, const std::string& binary)
{
    return fmt::format("{}{}\n{}\n", magic, sha256(key), sha256(binary));
}

std::filesystem::path file_of(const std::filesystem::path& folder, const std::string& key)
{
    return folder / (sha256(key) + ".bin");
}

} // namespace

bool uses_cache(KernelCache policy, const DeviceInfo& device)
{
    if (policy != KernelCache::automatic) return policy == KernelCache::always;
    const auto& known = platforms_with_a_cache;
    return std::find(known.begin(), known.end(), device.platform_name) == known.end();
}

std::filesystem::path cache_folder()
{
    const auto absolute = [](const char* path) { return path && *path == '/'; };
    if (const char* cache = std::getenv("XDG_CACHE_HOME"); absolute(cache))
        return std::filesystem::path(cache) / "clucida";
    if (const char* home = std::getenv("HOME"); absolute(home))
        return std::filesystem::path(home) / ".cache" / "clucida";
    return {};
}

std::string cache_key(const std::string& source, const std::string& options, const DeviceInfo& device)
{
    std::string key;
    for (const std::string* part : {&options, &device.platform_name, &device.platform_version, &device.name,
                                    &device.vendor, &device.version, &device.driver, &source})
        key += fmt::format("{}\n{}\n", part->size(), *part);
    return key;
}

std::optional<std::string> load_cached(const std::filesystem::path& folder, const std::string& key)
{
    try {
        std::string content = read_file(file_of(folder, key));
        const std::size_t header = magic.size() + std::size_t{2} * 65;
        if (content.size() <= header) return std::nullopt;
        std::string binary = content.substr(header);
        if (content.compare(0, header, header_of(key, binary)) != 0) return std::nullopt;
        return binary;
    } catch (const Failure&) {
        return std::nullopt;
    }
}

bool store_cached(const std::filesystem::path& folder, const std::string& key, const std::string& binary)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (folder.empty() || error) return false;
    try {
        write_file(file_of(folder, key), header_of(key, binary) + binary);
        return true;
    } catch (const Failure&) {
        return false;
    }
}

} // namespace clucida::host
