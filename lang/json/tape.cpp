#include "lang/json/tape.hpp"

#include <charconv>
#include <optional>

#include "lang/text/utf8.hpp"

namespace sdlc::lang {

std::string_view describe(const JsonNode& node) noexcept {
  switch (node.type) {
    case JsonNodeType::Null: return "null";
    case JsonNodeType::Bool: return node.number != 0 ? "true" : "false";
    case JsonNodeType::Number: return "a number";
    case JsonNodeType::String: return "a string";
    case JsonNodeType::Array: return "an array";
    case JsonNodeType::Object: return "an object";
    case JsonNodeType::Error: break;
  }
  return "";
}

namespace {

bool is_high_surrogate(unsigned unit) { return (unit & 0xFC00) == 0xD800; }
bool is_low_surrogate(unsigned unit) { return (unit & 0xFC00) == 0xDC00; }

constexpr std::size_t kUnicodeEscapeSize = 6;  // \uXXXX

/// The value of the escape \uXXXX at the beginning of the text.
std::optional<unsigned> code_unit_at(std::string_view text) {
  if (text.size() < kUnicodeEscapeSize || !text.starts_with("\\u")) return std::nullopt;
  unsigned unit = 0;
  const char* end = text.data() + kUnicodeEscapeSize;
  if (std::from_chars(text.data() + 2, end, unit, 16).ptr != end) return std::nullopt;
  return unit;
}

/// Appends the character of the escape \u… at the beginning of the text; returns the escape's size.
std::size_t append_unicode(std::string_view escape, std::string& out) {
  constexpr char32_t kReplacement = 0xFFFD;
  const auto unit = code_unit_at(escape);
  if (!unit) {
    append_utf8(kReplacement, out);
    return 2;
  }
  if (!is_high_surrogate(*unit) && !is_low_surrogate(*unit)) {
    append_utf8(*unit, out);
    return kUnicodeEscapeSize;
  }
  const auto next = code_unit_at(escape.substr(kUnicodeEscapeSize));
  if (is_high_surrogate(*unit) && next && is_low_surrogate(*next)) {
    append_utf8(0x10000 + ((*unit & 0x3FF) << 10) + (*next & 0x3FF), out);
    return 2 * kUnicodeEscapeSize;
  }
  append_utf8(kReplacement, out);
  return kUnicodeEscapeSize;
}

}  // namespace

std::string unescape(std::string_view content) {
  std::string text;
  while (true) {
    const std::size_t backslash = content.find('\\');
    text += content.substr(0, backslash);
    if (backslash == std::string_view::npos || backslash + 1 == content.size()) return text;

    content.remove_prefix(backslash);
    std::size_t size = 2;
    switch (content[1]) {
      case 'b': text += '\b'; break;
      case 'f': text += '\f'; break;
      case 'n': text += '\n'; break;
      case 'r': text += '\r'; break;
      case 't': text += '\t'; break;
      case 'u': size = append_unicode(content, text); break;
      default: text += content[1];
    }
    content.remove_prefix(size);
  }
}

std::string_view member_name(const SourceFile& file, const JsonNode& name, std::string& buffer) {
  const std::string_view content = file.text(name.content());
  if (!name.has_escapes) return content;
  buffer = unescape(content);
  return buffer;
}

}  // namespace sdlc::lang
