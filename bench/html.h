/// Pages that hold all they need.
#pragma once

#include "bench/speed_table.h"

#include <string>
#include <string_view>
#include <vector>

namespace clucida::bench {

/// A page with that title, in light or dark as the reader has it; body is HTML.
std::string html_page(const std::string& title, const std::string& body);

/// level: 1..6
std::string html_heading(unsigned level, const std::string& text);
/// What stands between backquotes is code.
std::string html_paragraph(const std::string& text);
/// Paragraphs; those that begin with "- " are the items of a list.
std::string html_notes(const std::vector<std::string>& notes);
/// A table that may be wider than the page.
std::string html_table(const Table& table);

} // namespace clucida::bench
