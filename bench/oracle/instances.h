/// Everything that the oracle offers, for one real type: a file for each, since they take long to compile.
#pragma once

#include "bench/oracle/build_impl.h"
#include "bench/oracle/trace_impl.h"

// NOLINTBEGIN(bugprone-macro-parentheses): Real is a type.
#define CLUCIDA_ORACLE_INSTANCES(Real)                                                                                 \
    template World<Real> build(const scene::Scene&, const Options&);                                                   \
    template Path observe(const World<Real>&, unsigned, unsigned, unsigned);                                           \
    template Path follow(const World<Real>&, const std::array<Real, 3>&, const std::array<Real, 3>&);                  \
    template Segment<Real> segment(const World<Real>&, const Branch<Real>&);                                           \
    template Branch<Real> observer_branch(const World<Real>&, unsigned, unsigned, unsigned);                           \
    template Branch<Real> disturbed(const World<Real>&, const Branch<Real>&, std::uint64_t);                           \
    template std::vector<Path> render(const World<Real>&, std::span<const Pixel>, unsigned);                           \
    template std::optional<Hit<Real>> next(const World<Real>&, const std::array<Real, 3>&, const std::array<Real, 3>&, \
                                           std::span<const Surface>)
// NOLINTEND(bugprone-macro-parentheses)
