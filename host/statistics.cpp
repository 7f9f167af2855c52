#include "host/statistics.h"

#include <fmt/format.h>

namespace clucida::host {
namespace {

constexpr StatisticsField fields[] = {
    {"rays", &Statistics::rays, false},
    {"primary", &Statistics::primary, false},
    {"reflected", &Statistics::reflected, false},
    {"refracted", &Statistics::refracted, false},
    {"shadow", &Statistics::shadow, false},
    {"queries", &Statistics::queries, false},
    {"full", &Statistics::full, false},
    {"tests", &Statistics::tests, false},
    {"silent", &Statistics::silent, false},
    {"parity", &Statistics::parity, true},
    {"nan", &Statistics::nan, true},
    {"interior_overflow", &Statistics::interior_overflow, true},
    {"stack_overflow", &Statistics::stack_overflow, true},
    {"stuck", &Statistics::stuck, true},
    {"cut_branches", &Statistics::cut_branches, false},
    {"hop_branches", &Statistics::hop_branches, false},
    {"truncated", &Statistics::truncated, false},
};
static_assert(std::size(fields) == STAT_COUNT);
static_assert(STAT_PARITY == 9 && STAT_STUCK == 13 && STAT_TRUNCATED == 16, "fields are in the order of LayoutStat");

} // namespace

std::span<const StatisticsField, STAT_COUNT> statistics_fields()
{
    return fields;
}

void add_rows(Statistics& to, std::span<const std::uint32_t> rows)
{
    for (std::size_t i = 0; i < rows.size(); ++i) to.*fields[i % STAT_COUNT].value += rows[i];
}

void add(Statistics& to, const Statistics& statistics)
{
    for (const StatisticsField& f : fields) to.*f.value += statistics.*f.value;
}

std::string describe_faults(const Statistics& statistics)
{
    std::string out;
    for (const StatisticsField& f : fields)
        if (f.fault && statistics.*f.value)
            out += fmt::format("{}{} {}", out.empty() ? "" : ", ", f.name, statistics.*f.value);
    return out;
}

} // namespace clucida::host
