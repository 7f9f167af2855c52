/// A cache of compiled kernels on disk, for OpenCL implementations that keep none of their own.
#pragma once

#include "host/device_choice.h"

#include <filesystem>
#include <optional>
#include <string>

namespace clucida::host {

enum class KernelCache {
    automatic, ///< used unless the platform keeps one itself
    off,
    always,
};

/// Whether programs for this device are worth keeping.
bool uses_cache(KernelCache policy, const DeviceInfo& device);

/// $XDG_CACHE_HOME/clucida, else ~/.cache/clucida; empty if there is no home.
std::filesystem::path cache_folder();

/// All that a compiled program depends on.
std::string cache_key(const std::string& source, const std::string& options, const DeviceInfo& device);

/// The program stored under the key, if there is one and it is whole.
std::optional<std::string> load_cached(const std::filesystem::path& folder, const std::string& key);

/// Keeps a program under the key. A cache that cannot be written is not an error: false.
bool store_cached(const std::filesystem::path& folder, const std::string& key, const std::string& binary);

} // namespace clucida::host
