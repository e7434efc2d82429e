#include "cli/report/table.hpp"

#include <algorithm>
#include <cstddef>

#include <fmt/format.h>

#include "cli/report/html.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::cli {

Table::Table(std::string caption, std::string_view headings) : caption_(std::move(caption)) {
  for (std::size_t begin = 0; begin <= headings.size();) {
    const std::size_t end = std::min(headings.find('|', begin), headings.size());
    std::string_view heading = headings.substr(begin, end - begin);
    const bool is_page_only = heading.starts_with('-');
    if (is_page_only) heading.remove_prefix(1);
    const bool is_number = heading.starts_with('#');
    if (is_number) heading.remove_prefix(1);
    columns_.push_back({std::string(heading), is_page_only, is_number});
    begin = end + 1;
  }
}

std::string Table::html() const {
  const auto class_of = [](const Column& column) {
    return column.is_number ? " class=\"number\"" : "";
  };
  std::string html = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table>\n"
      "<caption>{0}</caption>\n<thead><tr>",
      escaped(caption_));
  for (const Column& column : columns_) {
    html += fmt::format("<th scope=\"col\"{}>{}</th>", class_of(column), escaped(column.heading));
  }
  html += "</tr></thead>\n";
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto& [group, cells] = rows_[i];
    if (i > 0 && !group.empty()) html += "</tbody>\n";
    if (i == 0 || !group.empty()) html += group.empty() ? "<tbody>\n" : "<tbody>";
    html += "<tr>";
    if (!group.empty()) {
      html += fmt::format("<th scope=\"rowgroup\" colspan=\"{}\" class=\"group\">{}</th>",
                          columns_.size(), group);
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const char* tag = k == 0 ? "th" : "td";
      html += fmt::format("<{}{}{}>{}", tag, k == 0 ? " scope=\"row\"" : "",
                          class_of(columns_.at(k)), cells[k].html);
      if (!cells[k].small.empty()) html += fmt::format(" <small>{}</small>", cells[k].small);
      html += fmt::format("</{}>", tag);
    }
    html += "</tr>\n";
  }
  if (!rows_.empty()) html += "</tbody>\n";
  return html + "</table></div>\n";
}

std::string Table::text() const {
  std::vector<std::vector<std::string>> rows(1);
  for (const Column& column : columns_) rows[0].push_back(column.heading);
  for (const Row& row : rows_) {
    rows.emplace_back();
    for (const auto& [html, small] : row.cells) {
      rows.back().push_back(plain_text(small.empty() ? html : fmt::format("{} ({})", html, small)));
    }
  }
  std::vector<std::size_t> widths(columns_.size());
  for (const auto& row : rows) {
    for (std::size_t k = 0; k < row.size(); ++k) {
      widths[k] = std::max(widths[k], lang::count_code_points(row[k]));
    }
  }
  std::string text = caption_ + "\n";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::string line;
    for (std::size_t k = 0; k < rows[i].size(); ++k) {
      if (columns_[k].is_page_only) continue;
      line += "  " + rows[i][k];
      line.append(widths[k] - lang::count_code_points(rows[i][k]), ' ');
    }
    if (rows[i].empty()) line = plain_text(rows_[i - 1].group);
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

}  // namespace sdlc::cli
