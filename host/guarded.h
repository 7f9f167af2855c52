/// A command line program's run: what it throws becomes a message and an exit code.
#pragma once

#include <CLI/CLI.hpp>

namespace clucida::host {

/// Parses, which runs the chosen subcommand's callback, and returns the exit code (errors.h). Messages name the
/// program.
int run_guarded(CLI::App& app, int argc, char** argv);

} // namespace clucida::host
