#include "grammar/json_tokens.hpp"
#include "lang/token/match.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

namespace json = grammar::json;

/// Moves `at` to the end of what the first of the rules that matches there matches.
template <typename... Rules>
bool take(std::string_view text, std::uint32_t& at) noexcept {
  const std::uint32_t begin = at;
  return (((at = end_of_match<Rules>(text, at)) > begin) || ...);
}

TokenKind take_string(std::string_view text, std::uint32_t& at) noexcept {
  if (take<json::token_string, json::token_single_quoted, json::token_curly_quoted>(text, at)) {
    return TokenKind::String;
  }
  take<json::token_open_string>(text, at);
  return TokenKind::UnclosedString;
}

TokenKind take_comment(std::string_view text, std::uint32_t& at) noexcept {
  if (take<json::line_comment>(text, at)) return TokenKind::LineComment;
  if (take<json::token_comment>(text, at)) return TokenKind::BlockComment;
  const bool is_open = text.substr(at).starts_with("/*");
  at = is_open ? static_cast<std::uint32_t>(text.size()) : at + 1;
  return is_open ? TokenKind::UnclosedComment : TokenKind::Unknown;
}

}  // namespace

TokenKind take_json_token(std::string_view text, std::uint32_t& at) noexcept {
  switch (text[at]) {
    case '=': ++at; return TokenKind::Mark;
    case '"':
    case '\'': return take_string(text, at);
    case '#':
    case '/': return take_comment(text, at);
    default: break;
  }
  if (take<json::token_line_end>(text, at)) return TokenKind::LineEnd;
  if (take<json::token_blank>(text, at)) return TokenKind::Space;
  if (take<json::word>(text, at)) return TokenKind::Name;
  if (take<json::malformed_number>(text, at)) return TokenKind::Number;
  if (end_of_match<json::curly_quote>(text, at) > at) return take_string(text, at);
  take<json::token_bytes, json::token_character>(text, at);
  return TokenKind::Unknown;
}

}  // namespace sdlc::lang
