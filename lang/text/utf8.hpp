#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sdlc::lang {

/// The first character of a text.
struct DecodedChar {
  char32_t code_point = 0;  ///< of a valid character
  std::uint32_t size = 0;   ///< in bytes; 1 for an invalid byte
  bool is_valid = false;
};

/// Whether the byte continues a code point that an earlier byte begins.
constexpr bool is_continuation(char c) noexcept {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}

/// Precondition: `text` is not empty. Overlong forms, surrogates and code points beyond U+10FFFF
/// are not valid.
DecodedChar decode_utf8(std::string_view text) noexcept;

/// Precondition: `code_point` is at most U+10FFFF and no surrogate.
void append_utf8(char32_t code_point, std::string& out);

/// The number of code points; an invalid byte counts as one.
std::size_t count_code_points(std::string_view text) noexcept;

}  // namespace sdlc::lang
