/// The kernels' C core compiled by this machine's compiler for one scene's needs, and loaded.
#pragma once

#include "host/renderer.h"
#include "kernels/native_api.h"
#include "scene/needs.h"

#include <filesystem>
#include <memory>
#include <string>

namespace clucida::bench {

struct NativeBuild {
    std::string compiler;         ///< empty: clang, for PoCL is made of the same; else cc
    std::string march = "native"; ///< as -march= has it
    std::filesystem::path folder; ///< keeps what was compiled
};

struct NativeLibrary {
    std::shared_ptr<void> handle; ///< keeps the function
    decltype(&native_render_f) render = nullptr;
    double seconds = 0; ///< of compiling, unless the folder had it, and of loading
};

/// Compiles with the features and capacities of the needs and no others.
/// @throws host::Failure if there is no compiler, or with what it says
NativeLibrary native_library(const NativeBuild& build, const scene::Needs& needs, host::Precision precision,
                             host::KernelShape kernel);

/// Which compiler it is, and with which options: for people. @throws host::Failure
std::string describe(const NativeBuild& build);

} // namespace clucida::bench
