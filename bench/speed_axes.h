/// The contenders of a race as a product: each device, in each precision, with each kernel, and so on.
#pragma once

#include "bench/speed_task.h"
#include "host/device_choice.h"

#include <optional>
#include <string>
#include <vector>

namespace clucida::bench {

/// Each axis has one value at least, but for devices where native is set.
struct SpeedAxes {
    std::vector<host::DeviceInfo> devices;
    bool native = false; ///< also the native build
    std::vector<host::Precision> precisions{host::Precision::single};
    std::vector<std::optional<host::KernelShape>> kernels{std::nullopt};
    std::vector<std::optional<host::Shape>> groups{std::nullopt}; ///< of the kernel of pixels on devices
    std::vector<unsigned> threads{0};                             ///< of CPUs; 0: all
    std::vector<host::Shape> pictures{{640, 360}};
    std::vector<unsigned> samples{1};
    std::vector<std::optional<unsigned>> max_hops{std::nullopt}; ///< nullopt: the scene's
    std::vector<std::optional<double>> cutoffs{std::nullopt};    ///< likewise
};

constexpr std::size_t most_contenders = 1000;
constexpr std::size_t most_processes = 64; ///< that live at the same time

/// Precision by precision, device by device. What an axis means nothing to is not multiplied by it: threads are for
/// CPUs, groups for the kernel of pixels.
/// @throws host::UsageError for more contenders, or processes that they need, than are possible
std::vector<SpeedContender> contenders_of(const SpeedAxes& axes);

/// Words of the command line. @throws host::UsageError
unsigned parse_thread_limit(const std::string& text);                   ///< "all" is 0
std::optional<host::KernelShape> parse_kernel(const std::string& text); ///< "auto", "pixels", "packets"
std::optional<host::Shape> parse_local_size(const std::string& text);   ///< "auto" or WxH
std::optional<unsigned> parse_max_hops(const std::string& text);        ///< "scene" or 1..1000000
std::optional<double> parse_cutoff(const std::string& text);            ///< "scene" or 0..1
unsigned parse_samples(const std::string& text);                        ///< 1..2^20

} // namespace clucida::bench
