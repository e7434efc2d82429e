#pragma once

namespace sdlc::lang {

/// The closing bracket for `(`, `[` or `{`.
constexpr char closing_bracket(char open) noexcept {
  return open == '{' ? '}' : open == '[' ? ']' : ')';
}

/// Whether `close` closes the bracket `open`.
constexpr bool is_bracket_pair(char open, char close) noexcept {
  return (open == '(' || open == '[' || open == '{') && close == closing_bracket(open);
}

}  // namespace sdlc::lang
