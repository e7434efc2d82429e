#include "cli/report/html.hpp"

#include <cstdint>

#include <fmt/format.h>

#include "lang/text/display_width.hpp"

namespace sdlc::cli {

std::string escaped(std::string_view text) {
  std::string html;
  for (const char c : lang::printable(text)) {
    switch (c) {
      case '&': html += "&amp;"; break;
      case '<': html += "&lt;"; break;
      case '>': html += "&gt;"; break;
      case '"': html += "&quot;"; break;
      case '\'': html += "&#39;"; break;
      default: html += c;
    }
  }
  return html;
}

std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::string_view triple = bytes.substr(i, 3);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      bits = bits << 8 | (k < triple.size() ? static_cast<unsigned char>(triple[k]) : 0u);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      text += k <= triple.size() ? kDigits[bits >> (18 - 6 * k) & 63] : '=';
    }
  }
  return text;
}

HtmlTable::HtmlTable(std::string_view caption, std::string_view columns) {
  out_ = fmt::format(
      "<div class=\"scroll\" tabindex=\"0\" role=\"region\" aria-label=\"{0}\"><table>\n"
      "<caption>{0}</caption>\n<thead><tr>",
      escaped(caption));
  for (std::size_t begin = 0; begin <= columns.size();) {
    const std::size_t end = std::min(columns.find('|', begin), columns.size());
    std::string_view heading = columns.substr(begin, end - begin);
    const bool is_number = heading.starts_with('#');
    if (is_number) heading.remove_prefix(1);
    columns_ += is_number ? '#' : ' ';
    out_ += fmt::format("<th scope=\"col\"{}>{}</th>", is_number ? " class=\"number\"" : "",
                        escaped(heading));
    begin = end + 1;
  }
  out_ += "</tr></thead>\n";
}

void HtmlTable::group(std::string_view html) {
  end_group();
  out_ +=
      fmt::format("<tbody><tr><th scope=\"rowgroup\" colspan=\"{}\" class=\"group\">{}</th></tr>\n",
                  columns_.size(), html);
  is_in_group_ = true;
}

HtmlTable& HtmlTable::row() {
  end_row();
  if (!is_in_group_) out_ += "<tbody>\n";
  is_in_group_ = is_in_row_ = true;
  out_ += "<tr>";
  return *this;
}

HtmlTable& HtmlTable::cell(std::string_view html) { return cell(html, ""); }

HtmlTable& HtmlTable::cell(std::string_view html, std::string_view small) {
  const char* tag = column_ == 0 ? "th" : "td";
  out_ += fmt::format("<{}{}{}>{}", tag, column_ == 0 ? " scope=\"row\"" : "",
                      columns_[column_] == '#' ? " class=\"number\"" : "", html);
  if (!small.empty()) out_ += fmt::format(" <small>{}</small>", small);
  out_ += fmt::format("</{}>", tag);
  ++column_;
  return *this;
}

std::string HtmlTable::finish() && {
  end_group();
  return std::move(out_) + "</table></div>\n";
}

void HtmlTable::end_row() {
  if (is_in_row_) out_ += "</tr>\n";
  is_in_row_ = false;
  column_ = 0;
}

void HtmlTable::end_group() {
  end_row();
  if (is_in_group_) out_ += "</tbody>\n";
  is_in_group_ = false;
}

}  // namespace sdlc::cli
