/// What `clucida-bench agreement` tells: a Markdown table, and JSON.
#pragma once

#include "bench/agreement.h"
#include "host/renderer.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdio>
#include <span>
#include <tuple>

namespace clucida::bench {

/// How a place was asked to render.
struct Way {
    host::Precision precision = host::Precision::single;
    host::KernelShape kernel = host::KernelShape::pixels;
    bool operator==(const Way&) const = default;
    bool operator<(const Way& b) const { return std::tie(precision, kernel) < std::tie(b.precision, b.kernel); }
};

/// A place's picture of a scene beside the first place's.
struct SceneAgreement {
    std::string scene, place, device; ///< place as the user named it, device in words
    Way way;
    Agreement agreement;
    std::string faults;  ///< that the kernels counted; empty: none
    std::string failure; ///< why there is no picture; empty: there is one
};

/// Pixels whose paths differ, of a million.
double flips_per_million(const Agreement& agreement);

/// A row for each place and way, over all scenes, with the last failure if it has no picture; beneath them every scene
/// of which a pixel's path or a value differs by more than one 8-bit step, faults and failures.
void print_agreement(std::FILE* to, std::span<const SceneAgreement> results, host::Shape size);

/// In Google Benchmark's shape: "context" and "benchmarks".
nlohmann::ordered_json agreement_json(std::span<const SceneAgreement> results, host::Shape size);

} // namespace clucida::bench
