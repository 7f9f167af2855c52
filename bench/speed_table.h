/// What `clucida-bench speed` tells people: a table, and what its figures are.
#pragma once

#include "bench/measure_speed.h"
#include "bench/speed_json.h"

#include <cstdio>
#include <span>
#include <string>
#include <vector>

namespace clucida::bench {

/// A table as text, to be written as Markdown or HTML.
struct Table {
    std::vector<std::string> head;
    std::vector<bool> is_figure; ///< of each column: aligned to the right
    std::vector<std::vector<std::string>> rows;
};

/// The scene's contenders as speed_rank.h ranks them; at the end those that failed, with the reason. Columns are those
/// that tell these contenders apart.
Table speed_table(const SceneSpeed& speed, const SpeedSettings& settings);

std::string markdown_head(const Table& table);
std::string markdown_rows(const Table& table);

/// What was measured, on how busy a machine, and what the contenders are: a paragraph each.
std::vector<std::string> speed_notes(std::span<const SceneSpeed> results, const SpeedSettings& settings,
                                     const Load& load);

} // namespace clucida::bench
