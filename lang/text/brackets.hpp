#pragma once

namespace sdlc::lang {

/// The bracket that closes `open`, one of `(`, `[` and `{`.
constexpr char closing_bracket(char open) noexcept {
  return open == '{' ? '}' : open == '[' ? ']' : ')';
}

/// Whether they are an opening bracket and the one that closes it.
constexpr bool is_bracket_pair(char open, char close) noexcept {
  return (open == '(' || open == '[' || open == '{') && close == closing_bracket(open);
}

}  // namespace sdlc::lang
