/// What `clucida-bench profile` tells: as Markdown, and as JSON in Google Benchmark's shape.
#pragma once

#include "bench/measure_profile.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdio>
#include <span>

namespace clucida::bench {

/// Sections on what was measured, one after the other.
void print_profile(std::FILE* to, const SceneProfile& profile, const ProfileSettings& settings,
                   const host::DeviceInfo& device);

/// Its sections: rays and what became of them; what stages cost; what does not depend on the picture.
void print_counts(std::FILE* to, const SceneProfile& profile, const ProfileSettings& settings);
void print_times(std::FILE* to, const SceneProfile& profile, const ProfileSettings& settings,
                 const host::DeviceInfo& device);
void print_fixed(std::FILE* to, const SceneProfile& profile);

/// What machine code there is, and what of it was executed; what that says of the processor.
void print_code(std::FILE* to, const SceneProfile& profile);
void print_limits(std::FILE* to, const SceneProfile& profile);

/// "context" and "benchmarks".
nlohmann::ordered_json profile_json(std::span<const SceneProfile> profiles, const ProfileSettings& settings,
                                    const host::DeviceInfo& device);

/// All rays of a picture, shadow rays too.
std::uint64_t all_rays(const host::Statistics& counted);

/// "left out", "twice", "instead", "-"
const char* how_name(How how);

} // namespace clucida::bench
