#include "bench/report_files.h"

#include "bench/html.h"
#include "bench/recommendations.h"
#include "bench/speed_axes.h"
#include "bench/speed_files.h"
#include "bench/write_json.h"
#include "host/atomic_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string_view>

namespace clucida::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* title = "Speed and error on this computer";

Table device_table(const std::vector<host::DeviceInfo>& devices)
{
    Table out{{"device", "name", "kind", "compute units", "double", "platform", "driver", "usable"},
              {false, false, false, true, false, false, false, false},
              {}};
    for (const host::DeviceInfo& d : devices)
        out.rows.push_back({host::place(d), d.name, host::kind_name(d.kind), std::to_string(d.compute_units),
                            d.has_double ? "yes" : "no",
                            d.native ? "-" : fmt::format("{}, {}", d.platform_name, d.platform_version), d.driver,
                            d.usable ? "yes" : "no"});
    return out;
}

Json device_json(const host::DeviceInfo& d)
{
    return {{"device", host::place(d)},
            {"name", d.name},
            {"kind", host::kind_name(d.kind)},
            {"compute_units", d.compute_units},
            {"global_bytes", d.global_bytes},
            {"double", d.has_double},
            {"platform", d.platform_name},
            {"platform_version", d.platform_version},
            {"driver", d.driver},
            {"usable", d.usable}};
}

/// The rows of all scenes, which have the same columns.
Table table_of(const ReportPart& part)
{
    Table out;
    for (const SceneSpeed& scene : part.results) {
        Table one = speed_table(scene, part.settings);
        out.head = std::move(one.head);
        out.is_figure = std::move(one.is_figure);
        for (auto& row : one.rows) out.rows.push_back(std::move(row));
    }
    return out;
}

std::string part_html(const ReportPart& part, const Load& load, DeviceColors& colors)
{
    std::string out = html_heading(2, part.title) + html_paragraph(part.what);
    for (const NamedPlot& plot : plots_of(part, colors, PlotUse::page)) out += plot.svg;
    if (part.plots == PartPlots::fronts) out += html_table(recommendation_table(part.results, recommended_errors));
    out += html_table(table_of(part));
    return out + html_notes(speed_notes(part.results, part.settings, load));
}

std::string markdown_table(const Table& table)
{
    return fmt::format("{}{}\n", markdown_head(table), markdown_rows(table));
}

std::string part_markdown(const ReportPart& part, const Load& load, DeviceColors& colors)
{
    std::string out = fmt::format("## {}\n{}\n\n", part.title, part.what);
    for (const NamedPlot& plot : plots_of(part, colors, PlotUse::file))
        out += fmt::format("![{0}]({0}.svg)\n\n", plot.name);
    if (part.plots == PartPlots::fronts) out += markdown_table(recommendation_table(part.results, recommended_errors));
    out += markdown_table(table_of(part));
    for (const std::string& note : speed_notes(part.results, part.settings, load)) out += note + "\n\n";
    return out;
}

std::string introduction()
{
    return "By `clucida-bench report`, clucida " CLUCIDA_VERSION ".";
}

std::string page_of(const Report& report)
{
    DeviceColors colors;
    std::string body =
        html_heading(1, title) + html_paragraph(introduction()) + html_table(device_table(report.devices));
    for (const ReportPart& part : report.parts) body += part_html(part, report.load, colors);
    return html_page(title, body);
}

std::string markdown_of(const Report& report)
{
    DeviceColors colors;
    std::string out =
        fmt::format("# {}\n{}\n\n{}", title, introduction(), markdown_table(device_table(report.devices)));
    for (const ReportPart& part : report.parts) out += part_markdown(part, report.load, colors);
    return out;
}

} // namespace

Json report_json(const Report& report)
{
    Json out = speed_json({}, report.parts.front().settings, report.load);
    out["context"].erase("error_from"); // each benchmark tells its own
    out["context"].erase("rounds");
    for (const host::DeviceInfo& d : report.devices) out["context"]["devices"].push_back(device_json(d));
    for (const ReportPart& part : report.parts) {
        Json one = speed_json(part.results, part.settings, report.load);
        for (Json& b : one["benchmarks"]) {
            const auto name = b["name"].get<std::string>();
            b["name"] = part.name + name.substr(std::string_view("speed").size());
            out["benchmarks"].push_back(std::move(b));
        }
    }
    return out;
}

void write_report(const std::filesystem::path& folder, const Report& report)
{
    DeviceColors colors;
    for (const ReportPart& part : report.parts) write_plots(folder, plots_of(part, colors, PlotUse::file));
    write_json((folder / "report.json").string(), report_json(report));
    host::write_file(folder / "report.md", markdown_of(report));
    host::write_file(folder / "report.html", page_of(report));
}

} // namespace clucida::bench
