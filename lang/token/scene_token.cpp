#include <array>

#include "grammar/scene_tokens.hpp"
#include "lang/token/match.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// What a token is that begins with this byte, as far as one byte tells.
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
  set("\n\r", TokenKind::LineEnd);
  set("0123456789", TokenKind::Number);
  set("\"", TokenKind::String);
  set("#", TokenKind::Color);
  set("([{", TokenKind::Open);
  set(")]}", TokenKind::Close);
  set(":,.=!<>+-*/^", TokenKind::Mark);
  return kinds;
}();

/// Nested comments are counted: a rule would recurse as deep as they nest.
Token block_comment(std::string_view text, std::uint32_t at) noexcept {
  std::size_t depth = 0;
  for (std::size_t i = at; i + 1 < text.size();) {
    if (text[i] == '/' && text[i + 1] == '*') {
      ++depth;
      i += 2;
    } else if (text[i] == '*' && text[i + 1] == '/') {
      i += 2;
      if (--depth == 0) return {{at, static_cast<std::uint32_t>(i)}, TokenKind::BlockComment};
    } else {
      ++i;
    }
  }
  return {{at, static_cast<std::uint32_t>(text.size())}, TokenKind::UnclosedComment};
}

Token name(std::string_view text, std::uint32_t at) noexcept {
  const std::uint32_t end = end_of_match<grammar::identifier>(text, at);
  const bool may_go_on = end < text.size() && static_cast<unsigned char>(text[end]) >= 0x80;
  if (!may_go_on) [[likely]]
    return {{at, end}, TokenKind::Name};
  const std::uint32_t foreign_end = end_of_match<grammar::identifier_token>(text, at);
  return {{at, foreign_end}, foreign_end > end ? TokenKind::ForeignName : TokenKind::Name};
}

Token string(std::string_view text, std::uint32_t at) noexcept {
  const std::uint32_t end = end_of_match<grammar::string_token>(text, at);
  if (end > at) return {{at, end}, TokenKind::String};
  return {{at, end_of_match<grammar::string_open>(text, at)}, TokenKind::UnclosedString};
}

/// What is no token of a correct text.
Token unknown(std::string_view text, std::uint32_t at) noexcept {
  if (at == 0 && text.starts_with("\xEF\xBB\xBF")) return {{0, 3}, TokenKind::Space};
  const std::uint32_t name_end = end_of_match<grammar::identifier_token>(text, at);
  if (name_end > at) return {{at, name_end}, TokenKind::ForeignName};
  const std::uint32_t bytes_end = end_of_match<grammar::character_bytes>(text, at);
  if (bytes_end > at) return {{at, bytes_end}, TokenKind::Unknown};
  return {{at, end_of_match<grammar::character_other>(text, at)}, TokenKind::Unknown};
}

Token mark(std::string_view text, std::uint32_t at) noexcept {
  const char c = text[at], next = char_at(text, at + 1);
  if (c == '/' && next == '*') return block_comment(text, at);
  if (c == '/' && next == '/') {
    const std::uint32_t doc_end = end_of_match<grammar::doc>(text, at);
    if (doc_end > at) return {{at, doc_end}, TokenKind::DocComment};
    return {{at, end_of_match<grammar::comment_line>(text, at)}, TokenKind::LineComment};
  }
  if (c == '.' && is_digit(next)) {
    return {{at, end_of_match<grammar::number_token>(text, at)}, TokenKind::Number};
  }
  const std::uint32_t end = end_of_match<grammar::compare_token>(text, at);
  if (end > at) return {{at, end}, TokenKind::Mark};
  return {{at, at + 1}, c == '!' ? TokenKind::Unknown : TokenKind::Mark};
}

}  // namespace

Token scene_token(std::string_view text, std::uint32_t at) noexcept {
  if (at >= text.size()) return {{at, at}, TokenKind::End};
  const TokenKind kind = kKinds[static_cast<unsigned char>(text[at])];
  switch (kind) {
    case TokenKind::Space: return {{at, end_of_match<grammar::space_in_line>(text, at)}, kind};
    case TokenKind::LineEnd: return {{at, end_of_match<grammar::space_line_end>(text, at)}, kind};
    case TokenKind::Name: return name(text, at);
    case TokenKind::Number: return {{at, end_of_match<grammar::number_token>(text, at)}, kind};
    case TokenKind::String: return string(text, at);
    case TokenKind::Color: {
      const std::uint32_t end = end_of_match<grammar::color>(text, at);
      return end > at ? Token{{at, end}, kind} : Token{{at, at + 1}, TokenKind::Unknown};
    }
    case TokenKind::Open:
    case TokenKind::Close: return {{at, at + 1}, kind};
    case TokenKind::Mark: return mark(text, at);
    default: return unknown(text, at);
  }
}

}  // namespace sdlc::lang
