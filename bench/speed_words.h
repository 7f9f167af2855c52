/// How a contender's parts are called in tables, names and plots.
#pragma once

#include "bench/measure_speed.h"

#include <string>

namespace clucida::bench {

std::string place_name(const SpeedContender& c);                  ///< "0:0", "native", "native-build"
std::string kernel_name(std::optional<host::KernelShape> kernel); ///< "auto", "pixels", "packets"
std::string size_name(host::Shape size);                          ///< "320x180"
std::string hops_name(const SpeedView& view);                     ///< "scene" or a number
std::string cutoff_name(const SpeedView& view);                   ///< likewise
std::string group_name(const SpeedContender& c);                  ///< "auto" or "8x8"
std::string thread_count(const SpeedReport& r);                   ///< "-" where there are none to speak of

/// "speed/glass.clu/0:0/auto/float/threads:all/48x27", and what is not as it is by default: the samples, the hops, the
/// cutoff, the local size. Tells reports of the same thing apart from others, also from run to run.
std::string benchmark_name(const std::string& scene, const SpeedContender& c);

/// If it failed, what was asked for.
std::optional<host::KernelShape> kernel_that_ran(const SpeedReport& r);

/// What went wrong, for a cell of a table: the first line, not too much of it.
std::string brief(const std::string& failure);

/// "0:0 pthread-skylake-avx512" : the device's number and its name, cut short.
std::string device_name(const SpeedReport& r);

double rays_of(const SpeedReport& r); ///< of one picture, shadow rays too
double nanoseconds_per_ray(const SpeedReport& r);
/// A million a second of what a picture counts so many of.
double millions_a_second(const SpeedReport& r, double count);

} // namespace clucida::bench
