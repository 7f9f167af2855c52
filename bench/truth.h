/// The oracle behind one interface, whatever its real type.
#pragma once

#include "bench/oracle/oracle.h"

#include <functional>
#include <span>
#include <string>
#include <vector>

namespace clucida::bench {

enum class RealType { float64, long_double, quad, mpfr };

/// "double", "long-double", "quad" or "mpfr". @throws host::UsageError
RealType real_type(const std::string& name);

/// Paths of pixels, in their order. Holds the scene.
using Truth = std::function<std::vector<oracle::Path>(std::span<const oracle::Pixel>)>;

/// threads: at once, from 1. @throws host::UsageError for what the oracle does not imitate, scene::Error
Truth make_truth(const scene::Scene& scene, const oracle::Options& options, RealType type, unsigned threads);

} // namespace clucida::bench
