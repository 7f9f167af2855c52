#include "bench/speed_files.h"

#include "bench/html.h"
#include "bench/recommendations.h"
#include "host/atomic_file.h"
#include "host/errors.h"

#include <fmt/format.h>

namespace clucida::bench {

std::string speed_page(std::span<const SceneSpeed> results, const SpeedSettings& settings, const Load& load)
{
    DeviceColors colors;
    std::string body = html_heading(1, "Speed and error");
    for (const NamedPlot& plot : speed_plots(results, colors, PlotUse::page)) body += plot.svg;
    if (const Table table = recommendation_table(results, recommended_errors); !table.rows.empty())
        body += html_heading(2, "Fastest settings") + html_table(table);
    body += html_heading(2, "Figures");
    for (const SceneSpeed& scene : results)
        body += html_heading(3, scene.name) + html_table(speed_table(scene, settings));
    body += html_heading(2, "What they are");
    body += html_notes(speed_notes(results, settings, load));
    return html_page("clucida: speed and error", body);
}

void require_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) throw host::Failure(fmt::format("cannot make the folder {}: {}", folder.string(), error.message()));
}

void write_plots(const std::filesystem::path& folder, const std::vector<NamedPlot>& plots)
{
    require_folder(folder);
    for (const NamedPlot& plot : plots) host::write_file(folder / (plot.name + ".svg"), plot.svg);
}

} // namespace clucida::bench
