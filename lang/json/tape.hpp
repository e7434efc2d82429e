#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

namespace sdlc::lang {

enum class JsonNodeType : std::uint8_t {
  Null,
  Bool,
  Number,
  String,
  Array,
  Object,
  Error,  ///< a mistake that has been reported
};

/// A value. The children of an array or object follow it, up to `next`; those of an object are
/// names (strings) and values in turn.
struct JsonNode {
  Span span;               ///< with quotes or brackets
  double number = 0;       ///< of Number; 0 or 1 of Bool
  std::uint32_t next = 0;  ///< index after the node and its children
  JsonNodeType type = JsonNodeType::Null;
  std::uint8_t quote_size = 0;  ///< of String: bytes of each quote
  bool has_escapes = false;     ///< of String
  bool is_complete = true;      ///< false if the parse did not reach the closing bracket

  Span content() const noexcept { return {span.begin + quote_size, span.end - quote_size}; }
};
static_assert(sizeof(JsonNode) == 24);

/// The values of one part of a config, in the order of the text.
using Tape = std::vector<JsonNode>;

/// The number of elements of an array.
inline std::size_t count_elements(const Tape& tape, std::uint32_t array) noexcept {
  std::size_t count = 0;
  for (std::uint32_t i = array + 1; i < tape[array].next; i = tape[i].next) ++count;
  return count;
}

/// The value in messages: "a string", "true".
std::string_view describe(const JsonNode& node) noexcept;

/// The text between the quotes with its escapes resolved. An invalid escape, which has been
/// reported, becomes the character after the backslash, a lone surrogate U+FFFD.
std::string unescape(std::string_view content);

/// The name of a member: a view of the text, or of `buffer` if it has escapes.
std::string_view member_name(const SourceFile& file, const JsonNode& name, std::string& buffer);

}  // namespace sdlc::lang
