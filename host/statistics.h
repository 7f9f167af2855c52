/// What a frame's tracing counted (kernels/layout.h, enum LayoutStat), in 64 bits.
#pragma once

#include "kernels/layout.h"

#include <cstdint>
#include <span>
#include <string>

namespace clucida::host {

struct Statistics {
    std::uint64_t rays = 0; ///< of all kinds but shadow rays
    std::uint64_t primary = 0, reflected = 0, refracted = 0, shadow = 0;
    std::uint64_t queries = 0, full = 0, tests = 0, silent = 0;
    std::uint64_t parity = 0, nan = 0, interior_overflow = 0, stack_overflow = 0, stuck = 0; ///< faults: 0
    std::uint64_t cut_branches = 0, hop_branches = 0;
    std::uint64_t truncated = 0; ///< weight of both, in units of 2^-16
};

struct StatisticsField {
    const char* name;
    std::uint64_t Statistics::*value;
    bool fault; ///< anything but 0 is a defect
};

/// The fields in the order of LayoutStat.
std::span<const StatisticsField, STAT_COUNT> statistics_fields();

/// Adds the rows that a launch counted: STAT_SLOTS rows of STAT_COUNT.
void add_rows(Statistics& to, std::span<const std::uint32_t> rows);

void add(Statistics& to, const Statistics& statistics);

/// "parity 3, stuck 1"; empty if nothing is wrong.
std::string describe_faults(const Statistics& statistics);

} // namespace clucida::host
