#include "lang/explain/explain.hpp"

#include <algorithm>

#include "lang/explain/pages.hpp"

namespace sdlc::lang {

std::optional<std::string_view> explanation(std::string_view code) {
  const auto page = std::ranges::lower_bound(kPages, code, {}, &Page::name);
  if (page == kPages.end() || page->name != code) return std::nullopt;
  return page->text;
}

}  // namespace sdlc::lang
