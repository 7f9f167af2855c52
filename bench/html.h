/// Pages that hold all they need.
#pragma once

#include "bench/speed_table.h"

#include <string>
#include <string_view>

namespace clucida::bench {

/// A page with that title, in light or dark as the reader has it; body is HTML.
std::string html_page(const std::string& title, const std::string& body);

/// level: 1..6
std::string html_heading(unsigned level, const std::string& text);
std::string html_paragraph(const std::string& text);
/// A table that may be wider than the page.
std::string html_table(const Table& table);

} // namespace clucida::bench
