#include "bench/html.h"

#include "bench/plot.h"

#include <fmt/format.h>

namespace clucida::bench {
namespace {

constexpr const char* page_style =
    "body { font: 15px/1.5 system-ui, sans-serif; margin: 2em auto; padding: 0 1em; max-width: 60em; "
    "color: #1f2328; background: #ffffff }\n"
    "h1, h2, h3 { line-height: 1.25 }\n"
    "ul { padding-left: 1.3em }\n"
    ".wide { overflow-x: auto }\n"
    "table { border-collapse: collapse; font-size: 12px; white-space: nowrap }\n"
    "th, td { padding: 3px 8px; border-bottom: 1px solid #d1d9e0; text-align: left }\n"
    ".figure { text-align: right; font-variant-numeric: tabular-nums }\n"
    "@media (prefers-color-scheme: dark) {\n"
    "body { color: #e6edf3; background: #15191f }\n"
    "th, td { border-color: #3d444d }\n"
    "}\n";

std::string with_code(const std::string& text)
{
    std::string out;
    bool in_code = false;
    for (const char c : xml_text(text)) {
        if (c != '`') {
            out += c;
            continue;
        }
        out += in_code ? "</code>" : "<code>";
        in_code = !in_code;
    }
    return in_code ? out + "</code>" : out;
}

} // namespace

std::string html_page(const std::string& title, const std::string& body)
{
    return fmt::format("<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n"
                       "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n<title>{}</title>\n"
                       "<style>\n{}{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
                       xml_text(title), page_style, plot_style(), body);
}

std::string html_heading(unsigned level, const std::string& text)
{
    return fmt::format("<h{0}>{1}</h{0}>\n", level, xml_text(text));
}

std::string html_paragraph(const std::string& text)
{
    return fmt::format("<p>{}</p>\n", with_code(text));
}

std::string html_notes(const std::vector<std::string>& notes)
{
    std::string out;
    bool in_list = false;
    for (const std::string& note : notes) {
        const bool is_item = note.starts_with("- ");
        if (is_item != in_list) out += is_item ? "<ul>\n" : "</ul>\n";
        in_list = is_item;
        out += is_item ? fmt::format("<li>{}</li>\n", with_code(note.substr(2))) : html_paragraph(note);
    }
    return in_list ? out + "</ul>\n" : out;
}

std::string html_table(const Table& table)
{
    const auto row = [&](const char* cell, const std::vector<std::string>& texts) {
        std::string out = "<tr>";
        for (std::size_t i = 0; i < texts.size(); ++i)
            out += fmt::format("<{0}{1}>{2}</{0}>", cell, table.is_figure[i] ? " class=\"figure\"" : "",
                               xml_text(texts[i]));
        return out + "</tr>\n";
    };
    std::string out = "<div class=\"wide\">\n<table>\n" + row("th", table.head);
    for (const auto& texts : table.rows) out += row("td", texts);
    return out + "</table>\n</div>\n";
}

} // namespace clucida::bench
