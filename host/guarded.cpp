#include "host/guarded.h"

#include "host/errors.h"
#include "host/opencl.h"
#include "scene/error.h"

#include <fmt/format.h>

#include <new>

namespace clucida::host {

int run_guarded(CLI::App& app, int argc, char** argv)
{
    const std::string& program = app.get_name();
    const auto fail = [&](int code, const std::string& what) {
        fmt::print(stderr, "{}: error: {}\n", program, what);
        return code;
    };
    try {
        app.parse(argc, argv);
        return exit_done;
    } catch (const CLI::ParseError& e) {
        if (e.get_exit_code() == 0) return app.exit(e); // help, version
        return fail(exit_usage, fmt::format("{0}; see {1} --help and {1} COMMAND --help", e.what(), program));
    } catch (const scene::Error& e) { // says itself where and that it is an error
        fmt::print(stderr, "{}\n", e.what());
        return exit_usage;
    } catch (const UsageError& e) {
        return fail(exit_usage, e.what());
    } catch (const Interrupted& e) {
        fmt::print(stderr, "{}: {}\n", program, e.what());
        return exit_interrupted;
    } catch (const std::bad_alloc&) {
        return fail(exit_failed, "this computer's memory does not suffice");
    } catch (const cl::Error& e) {
        return fail(exit_failed, explain(e));
    } catch (const std::exception& e) {
        return fail(exit_failed, e.what());
    }
}

} // namespace clucida::host
