#include "bench/native_library.h"

#include "host/atomic_file.h"
#include "host/child_process.h"
#include "host/errors.h"
#include "host/kernel_source.h"
#include "host/sha256.h"
#include "host/stopwatch.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <cstdlib>
#include <sstream>
#include <vector>

namespace clucida::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_log = 2000; ///< characters of what a compiler says

bool is_program(const std::string& name)
{
    const char* path = std::getenv("PATH");
    std::istringstream folders(path ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (::access((fs::path(folder) / name).c_str(), X_OK) == 0) return true;
    return false;
}

std::string compiler_of(const NativeBuild& build)
{
    if (!build.compiler.empty()) return build.compiler;
    for (const char* name : {"clang", "cc"})
        if (is_program(name)) return name;
    throw host::Failure("there is no C compiler for the native build: install clang or gcc");
}

std::vector<std::string> options_of(const NativeBuild& build)
{
    return {"-O3", "-march=" + build.march, "-ffp-contract=off", "-fno-math-errno"};
}

/// The kernels' text as files that a compiler can include.
void write_sources(const fs::path& folder)
{
    for (const std::string& path : host::embedded_kernel_paths()) {
        const fs::path file = folder / path;
        fs::create_directories(file.parent_path());
        host::write_file(file, *host::embedded_kernel(path));
    }
}

void compile(const NativeBuild& build, const std::string& defines, const fs::path& library)
{
    const fs::path sources = build.folder / "sources";
    write_sources(sources);
    std::vector<std::string> command = options_of(build);
    command.insert(command.begin(), compiler_of(build));
    for (const char* word : {"-std=c11", "-fPIC", "-shared", "-DCLU_ONLY_RENDER"}) command.emplace_back(word);
    std::istringstream words(defines);
    for (std::string word; words >> word;) command.push_back(word);
    command.push_back("-I" + sources.string());
    command.push_back((sources / "kernels/native.c").string());
    for (const std::string& word : {std::string("-o"), library.string(), std::string("-lm")}) command.push_back(word);

    const std::string log = (build.folder / "compiler.log").string();
    if (!host::run_child(command, log))
        throw host::Failure(fmt::format("the native build failed: {}\n{}", fmt::join(command, " "),
                                        host::read_file(log).substr(0, most_log)));
}

} // namespace

NativeLibrary native_library(const NativeBuild& build, const scene::Needs& needs, host::Precision precision,
                             host::KernelShape kernel)
{
    const host::Stopwatch watch;
    const bool twofold = precision == host::Precision::twofold;
    const std::string defines = scene::build_options(needs) + (twofold ? " -DCLU_DOUBLE" : "");
    const fs::path library = build.folder / (host::sha256(defines) + ".so");
    if (!fs::exists(library)) compile(build, defines, library);

    NativeLibrary out;
    void* const handle = ::dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!handle) throw host::Failure(fmt::format("the native build cannot be loaded: {}", ::dlerror()));
    out.handle = std::shared_ptr<void>(handle, [](void* h) { ::dlclose(h); });
    const std::string name = std::string("native_render") + (kernel == host::KernelShape::packets ? "_packets" : "") +
                             (twofold ? "_d" : "_f");
    out.render = reinterpret_cast<decltype(out.render)>(::dlsym(handle, name.c_str()));
    if (!out.render) throw host::Failure(fmt::format("the native build lacks its function: {}", ::dlerror()));
    out.seconds = watch.seconds();
    return out;
}

std::string describe(const NativeBuild& build)
{
    const std::string log = (build.folder / "version.log").string();
    const std::string compiler = compiler_of(build);
    if (!host::run_child({compiler, "--version"}, log))
        throw host::Failure(fmt::format("{} does not tell its version", compiler));
    const std::string version = host::read_file(log);
    return fmt::format("{} {}", version.substr(0, version.find('\n')), fmt::join(options_of(build), " "));
}

} // namespace clucida::bench
