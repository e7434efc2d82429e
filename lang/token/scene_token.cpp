#include <array>

#include "grammar/scene_tokens.hpp"
#include "lang/token/match.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// The kind of a token by its first byte, if that decides.
constexpr std::array<TokenKind, 256> kKinds = [] {
  std::array<TokenKind, 256> kinds{};
  kinds.fill(TokenKind::Unknown);
  const auto set = [&](std::string_view bytes, TokenKind kind) {
    for (const char c : bytes) kinds[static_cast<unsigned char>(c)] = kind;
  };
  for (int c = 0; c < 128; ++c) {
    if (is_letter(static_cast<char>(c))) kinds[static_cast<std::size_t>(c)] = TokenKind::Name;
  }
  set(" \t", TokenKind::Space);
  set("\r", TokenKind::LineEnd);
  set("0123456789", TokenKind::Number);
  set("\"", TokenKind::String);
  set("#", TokenKind::Color);
  set(".=!<>+-*/^", TokenKind::Mark);
  return kinds;
}();

/// Moves `at` to the end of what the rule matches there; false if it does not match.
template <typename Rule>
bool take(std::string_view text, std::uint32_t& at) noexcept {
  const std::uint32_t begin = at;
  at = end_of_match<Rule>(text, at);
  return at > begin;
}

// Each of these moves `at` to the end of a token. What is rare is kept out of the way of what is
// not: with it the caller would save registers for every token.

/// Nested comments are counted: a rule would recurse as deep as they nest.
[[gnu::noinline]] TokenKind take_block_comment(std::string_view text, std::uint32_t& at) noexcept {
  std::size_t depth = 0;
  for (std::size_t i = at; i + 1 < text.size();) {
    if (text[i] == '/' && text[i + 1] == '*') {
      ++depth;
      i += 2;
    } else if (text[i] == '*' && text[i + 1] == '/') {
      i += 2;
      if (--depth > 0) continue;
      at = static_cast<std::uint32_t>(i);
      return TokenKind::BlockComment;
    } else {
      ++i;
    }
  }
  at = static_cast<std::uint32_t>(text.size());
  return TokenKind::UnclosedComment;
}

[[gnu::noinline]] TokenKind take_comment(std::string_view text, std::uint32_t& at) noexcept {
  if (text[at + 1] == '*') return take_block_comment(text, at);
  if (take<grammar::doc>(text, at)) return TokenKind::DocComment;
  take<grammar::comment_line>(text, at);
  return TokenKind::LineComment;
}

[[gnu::noinline]] TokenKind take_string(std::string_view text, std::uint32_t& at) noexcept {
  if (take<grammar::string_token>(text, at)) return TokenKind::String;
  take<grammar::string_open>(text, at);
  return TokenKind::UnclosedString;
}

[[gnu::noinline]] TokenKind take_color(std::string_view text, std::uint32_t& at) noexcept {
  if (take<grammar::color>(text, at)) return TokenKind::Color;
  ++at;
  return TokenKind::Unknown;
}

/// Tokens that a correct text does not contain.
[[gnu::noinline]] TokenKind take_unknown(std::string_view text, std::uint32_t& at) noexcept {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (at == 0 && text.starts_with(kByteOrderMark)) {
    at = kByteOrderMark.size();
    return TokenKind::Space;
  }
  if (take<grammar::identifier_token>(text, at)) return TokenKind::ForeignName;
  if (!take<grammar::character_bytes>(text, at)) take<grammar::character_other>(text, at);
  return TokenKind::Unknown;
}

/// A name that goes on with a byte that is not ASCII.
[[gnu::noinline]] TokenKind take_foreign_name(std::string_view text, std::uint32_t& at) noexcept {
  return take<grammar::identifier_token>(text, at) ? TokenKind::ForeignName : TokenKind::Name;
}

TokenKind take_name(std::string_view text, std::uint32_t& at) noexcept {
  take<grammar::identifier>(text, at);
  const bool is_foreign = at < text.size() && static_cast<unsigned char>(text[at]) >= 0x80;
  return is_foreign ? take_foreign_name(text, at) : TokenKind::Name;
}

TokenKind take_mark(std::string_view text, std::uint32_t& at) noexcept {
  const char c = text[at], next = char_at(text, at + 1);
  if (c == '/' && (next == '/' || next == '*')) return take_comment(text, at);
  if (c == '.' && is_digit(next)) {
    take<grammar::number_token>(text, at);
    return TokenKind::Number;
  }
  if (take<grammar::compare_token>(text, at)) return TokenKind::Mark;
  ++at;
  return c == '!' ? TokenKind::Unknown : TokenKind::Mark;
}

}  // namespace

TokenKind take_scene_token(std::string_view text, std::uint32_t& at) noexcept {
  const TokenKind kind = kKinds[static_cast<unsigned char>(text[at])];
  switch (kind) {
    case TokenKind::Space: take<grammar::space_in_line>(text, at); return kind;
    case TokenKind::LineEnd: take<grammar::space_line_end>(text, at); return kind;
    case TokenKind::Name: return take_name(text, at);
    case TokenKind::Number: take<grammar::number_token>(text, at); return kind;
    case TokenKind::String: return take_string(text, at);
    case TokenKind::Color: return take_color(text, at);
    case TokenKind::Mark: return take_mark(text, at);
    default: return take_unknown(text, at);
  }
}

}  // namespace sdlc::lang
