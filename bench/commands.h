/// The subcommands of `clucida-bench`, one file each.
#pragma once

#include <CLI/CLI.hpp>

namespace clucida::bench {

void add_agreement(CLI::App& app);
void add_agreement_worker(CLI::App& app);
void add_compare(CLI::App& app);
void add_error(CLI::App& app);
void add_profile(CLI::App& app);
void add_report(CLI::App& app);
void add_speed(CLI::App& app);
void add_speed_worker(CLI::App& app);

} // namespace clucida::bench
