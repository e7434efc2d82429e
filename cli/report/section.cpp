#include "cli/report/section.hpp"

#include <fmt/format.h>

#include "cli/report/html.hpp"

namespace sdlc::cli {

void Section::paragraph(std::string_view html, std::string_view css_class) {
  html_ += css_class.empty() ? fmt::format("<p>{}</p>\n", html)
                             : fmt::format("<p class=\"{}\">{}</p>\n", css_class, html);
  text_ += plain_text(html) + "\n";
}

void Section::callout(std::string_view sentence) {
  paragraph(fmt::format("<strong>Note:</strong> {}", escaped(sentence)), "callout");
}

void Section::table(const Table& table) {
  html_ += table.html();
  text_ += (text_.empty() ? "" : "\n") + table.text();
}

}  // namespace sdlc::cli
