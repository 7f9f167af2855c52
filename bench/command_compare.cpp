#include "bench/commands.h"
#include "bench/compare_reports.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace clucida::bench {
namespace {

struct CompareOptions {
    std::string old_file, new_file;
};

void run(const CompareOptions& o)
{
    const ReportComparison comparison = compare_reports(read_report(o.old_file), read_report(o.new_file));
    const Table table = comparison_table(comparison);
    fmt::print("{}{}", markdown_head(table), markdown_rows(table));
    for (const std::string& note : comparison_notes(comparison)) fmt::print("\n{}\n", note);
}

} // namespace

void add_compare(CLI::App& app)
{
    auto options = std::make_shared<CompareOptions>();
    CLI::App* command = app.add_subcommand("compare", "What became faster or slower from one report to another");
    command->add_option("old", options->old_file, "report of `speed --json` or `report`")
        ->required()
        ->option_text("OLD.json");
    command->add_option("new", options->new_file, "likewise")->required()->option_text("NEW.json");
    command->footer("Examples:\n"
                    "  clucida-bench compare before.json after.json\n"
                    "  clucida-bench speed scene.clu --compare before.json");
    command->callback([options] { run(*options); });
}

} // namespace clucida::bench
