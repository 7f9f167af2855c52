#include "host/commands.h"
#include "host/errors.h"
#include "host/interrupt.h"
#include "host/opencl.h"
#include "scene/error.h"

#include <fmt/format.h>

#include <new>

namespace {

using namespace clucida;

int fail(int code, const std::string& what)
{
    fmt::print(stderr, "clucida: error: {}\n", what);
    return code;
}

/// Runs the program and turns what it throws into a message and an exit code.
int guarded(CLI::App& app, int argc, char** argv)
{
    try {
        app.parse(argc, argv);
        return host::exit_done;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e); // help, version
        return fail(host::exit_usage, fmt::format("{}; see clucida --help and clucida COMMAND --help", e.what()));
    } catch (const scene::Error& e) { // says itself where and that it is an error
        fmt::print(stderr, "{}\n", e.what());
        return host::exit_usage;
    } catch (const host::UsageError& e) {
        return fail(host::exit_usage, e.what());
    } catch (const host::Interrupted& e) {
        fmt::print(stderr, "clucida: {}\n", e.what());
        return host::exit_interrupted;
    } catch (const std::bad_alloc&) {
        return fail(host::exit_failed, "this computer's memory does not suffice");
    } catch (const cl::Error& e) {
        return fail(host::exit_failed, host::explain(e));
    } catch (const std::exception& e) {
        return fail(host::exit_failed, e.what());
    }
}

} // namespace

int main(int argc, char** argv)
{
    host::catch_interrupts();
    CLI::App app("An OpenCL renderer of true optics.", "clucida");
    app.set_version_flag("--version", "clucida " CLUCIDA_VERSION);
    app.require_subcommand(1);
    app.footer("Examples:\n"
               "  clucida render scene.clu -s 1280x720 --samples 16\n"
               "  clucida devices\n"
               "  clucida inspect scene.clu\n"
               "  clucida compare a.png b.png\n"
               "\nclucida COMMAND --help tells more.");
    host::add_render(app);
    host::add_devices(app);
    host::add_inspect(app);
    host::add_compare(app);
    return guarded(app, argc, argv);
}
