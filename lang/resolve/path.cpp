#include "lang/resolve/path.hpp"

#include <algorithm>

namespace sdlc::lang {
namespace {

/// Drops the comment that `text` begins with.
void skip_comment(std::string_view& text) {
  if (text.starts_with("//")) {
    text.remove_prefix(std::min(text.find('\n'), text.size()));
    return;
  }
  int depth = 0;
  do {
    if (text.starts_with("/*") || text.starts_with("*/")) {
      depth += text.starts_with("/*") ? 1 : -1;
      text.remove_prefix(1);
    }
    text.remove_prefix(1);
  } while (depth > 0 && text.size() > 1);
}

}  // namespace

std::vector<std::string_view> split_path(std::string_view path) {
  constexpr std::string_view kBetween = ". \t\r\n";
  std::vector<std::string_view> names;
  while (true) {
    path.remove_prefix(std::min(path.find_first_not_of(kBetween), path.size()));
    if (path.empty()) return names;
    if (path.front() == '/') {
      skip_comment(path);
      continue;
    }
    const std::size_t end = std::min(path.find_first_of(". \t\r\n/"), path.size());
    names.push_back(path.substr(0, end));
    path.remove_prefix(end);
  }
}

}  // namespace sdlc::lang
