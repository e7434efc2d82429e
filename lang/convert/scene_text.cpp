#include "lang/convert/scene_text.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Control characters, marks of text direction, and spaces other than U+0020.
bool is_invisible(char32_t c) noexcept {
  const auto is_between = [c](char32_t first, char32_t last) { return c >= first && c <= last; };
  return c < 0x20 || is_between(0x7F, 0xA0) || c == 0xAD || c == 0x61C || c == 0x1680 ||
         is_between(0x2000, 0x200F) || is_between(0x2028, 0x202F) || is_between(0x205F, 0x206F) ||
         c == 0x3000 || c == 0xFEFF;
}

}  // namespace

std::string scene_string(std::string_view text) {
  std::string result = "\"";
  while (!text.empty()) {
    const DecodedChar c = decode_utf8(text);
    if (c.code_point == '"' || c.code_point == '\\') result += '\\';
    if (c.is_valid && is_invisible(c.code_point)) {
      result += fmt::format("\\u{:04x}", static_cast<std::uint32_t>(c.code_point));
    } else {
      result += text.substr(0, c.size);
    }
    text.remove_prefix(c.size);
  }
  return result + "\"";
}

void ObjectText::add(std::size_t order, std::string_view label, std::string value) {
  const auto place = std::ranges::upper_bound(entries_, order, {}, &Entry::order);
  entries_.insert(place, {.order = order, .label = std::string(label), .value = std::move(value)});
}

std::string ObjectText::str() const {
  std::vector<std::string> properties;
  for (const Entry& entry : entries_) {
    properties.push_back(fmt::format("{}: {}", entry.label, entry.value));
  }
  if (comments_.empty()) return fmt::format("{} {{ {} }}\n", head_, fmt::join(properties, ", "));
  for (const std::string& comment : comments_) properties.push_back("// " + comment);
  return fmt::format("{} {{\n{}\n}}\n", head_, fmt::join(properties, "\n"));
}

}  // namespace sdlc::lang
