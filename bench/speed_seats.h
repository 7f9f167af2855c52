/// The processes in which contenders race: one for all that differ in their view only.
#pragma once

#include "bench/measure_speed.h"
#include "bench/worker_process.h"

#include <filesystem>
#include <memory>

namespace clucida::bench {

struct Seat {
    SpeedTask task;   ///< of its first contender
    std::string name; ///< for errors
    host::Environment environment;
    double most_opening = 0;               ///< s; 0: no end
    std::unique_ptr<WorkerProcess> worker; ///< empty when it has failed
    std::string failure;
    SpeedReport found; ///< what opening it told
};

/// An environment in which OpenCL's implementations and this program keep compiled kernels in that folder.
host::Environment caches_in(const std::filesystem::path& folder);

/// A seat for each process that the contenders need, none of them open yet. Those of one program share a folder, in
/// which they find what one of them has compiled.
std::vector<Seat> make_seats(const host::SceneOptions& scene, const SpeedSettings& settings,
                             const std::filesystem::path& folder);

/// The seat of a contender. There is one.
Seat& seat_of(std::vector<Seat>& seats, const SpeedContender& contender);

/// Compiles in a process of its own, if none of the same program did before, here or in an earlier race, and then again
/// in the one that stays, which finds it compiled. @throws host::Failure, host::UsageError, host::Interrupted
void open_seat(std::vector<Seat>& seats, std::size_t which, CompiledPrograms* compiled);

} // namespace clucida::bench
