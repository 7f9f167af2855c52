/// The disturbances that are tried to explain what differs by rounding.
#pragma once

#include "bench/oracle/disturb.h"

namespace clucida::bench {

/// The most that an explanation may disturb anything by, in parts of its size (oracle/disturb.h says of what).
inline constexpr double flip_disturbance = 4 * 0x1p-24;

/// Number `seed` of them, from 1: the three kinds by turns.
inline oracle::Disturbance flip_disturbance_of(unsigned seed)
{
    return {seed, flip_disturbance, seed % 3 == 1, seed % 3 == 2};
}

} // namespace clucida::bench
