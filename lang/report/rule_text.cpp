#include "lang/report/rule_text.hpp"

#include <optional>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {
namespace {

/// A Markdown link at the beginning of a text.
struct Link {
  std::string_view text, target;
  std::size_t size = 0;  ///< in the text
};

std::optional<Link> link_at(std::string_view text) {
  const std::size_t middle = text.find("](");
  const std::size_t end = text.find(')', middle == std::string_view::npos ? 0 : middle);
  if (!text.starts_with('[') || middle == std::string_view::npos || end == std::string_view::npos ||
      text.substr(0, middle).find('\n') != std::string_view::npos) {
    return std::nullopt;
  }
  return Link{.text = text.substr(1, middle - 1),
              .target = text.substr(middle + 2, end - middle - 2),
              .size = end + 1};
}

/// Replaces links to other pages by their text, except in code between backticks.
std::string without_links(std::string_view text) {
  std::string result;
  bool is_code = false;
  while (!text.empty()) {
    if (text.front() == '`') is_code = !is_code;
    const std::optional<Link> link = is_code ? std::nullopt : link_at(text);
    if (link && !link->target.starts_with("http")) {
      result += link->text;
      text.remove_prefix(link->size);
    } else {
      result += text.front();
      text.remove_prefix(1);
    }
  }
  return result;
}

/// The page after its title and the empty line below it.
std::string_view body_of(std::string_view page) {
  const std::size_t end = page.find("\n\n");
  return page.starts_with("# ") && end != std::string_view::npos ? page.substr(end + 2) : page;
}

}  // namespace

std::string pascal_name(const DiagnosticInfo& info) {
  std::string name;
  bool is_word_begin = true;
  for (const char c : info.name) {
    if (c != '_') name += is_word_begin ? to_upper(c) : c;
    is_word_begin = c == '_';
  }
  return name;
}

std::string rule_title(const DiagnosticInfo& info) {
  std::string title = title_of(info);
  if (!title.empty()) title[0] = to_upper(title[0]);
  return title;
}

std::string first_paragraph(std::string_view page) {
  const std::string_view body = body_of(page);
  std::string line;
  for (const char c : without_links(body.substr(0, body.find("\n\n")))) {
    if (c == '\n') {
      line += ' ';
    } else if (c != '`') {
      line += c;
    }
  }
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string page_for_elsewhere(std::string_view page) { return without_links(body_of(page)); }

}  // namespace sdlc::lang
