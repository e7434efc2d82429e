#include "grammar/json_tokens.hpp"
#include "lang/token/match.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

namespace json = grammar::json;

/// The first of the rules that matches gives the token's end.
template <typename... Rules>
std::uint32_t end_of_any(std::string_view text, std::uint32_t at) noexcept {
  std::uint32_t end = at;
  static_cast<void>((((end = end_of_match<Rules>(text, at)) > at) || ...));
  return end;
}

Token string(std::string_view text, std::uint32_t at) noexcept {
  const std::uint32_t end =
      end_of_any<json::token_string, json::token_single_quoted, json::token_curly_quoted>(text, at);
  if (end > at) return {{at, end}, TokenKind::String};
  return {{at, end_of_match<json::token_open_string>(text, at)}, TokenKind::UnclosedString};
}

Token comment(std::string_view text, std::uint32_t at) noexcept {
  if (text[at] == '#' || text.substr(at).starts_with("//")) {
    return {{at, end_of_match<json::line_comment>(text, at)}, TokenKind::LineComment};
  }
  if (!text.substr(at).starts_with("/*")) return {{at, at + 1}, TokenKind::Unknown};
  const std::uint32_t end = end_of_match<json::token_comment>(text, at);
  if (end > at) return {{at, end}, TokenKind::BlockComment};
  return {{at, static_cast<std::uint32_t>(text.size())}, TokenKind::UnclosedComment};
}

}  // namespace

Token json_token(std::string_view text, std::uint32_t at) noexcept {
  if (at >= text.size()) return {{at, at}, TokenKind::End};
  switch (text[at]) {
    case '{':
    case '[':
    case '(': return {{at, at + 1}, TokenKind::Open};
    case '}':
    case ']':
    case ')': return {{at, at + 1}, TokenKind::Close};
    case ',':
    case ':':
    case '=': return {{at, at + 1}, TokenKind::Mark};
    case '"':
    case '\'': return string(text, at);
    case '#':
    case '/': return comment(text, at);
    case '\n':
    case '\r': return {{at, end_of_match<json::token_line_end>(text, at)}, TokenKind::LineEnd};
    default: break;
  }
  if (const auto end = end_of_match<json::token_blank>(text, at); end > at) {
    return {{at, end}, TokenKind::Space};
  }
  if (const auto end = end_of_match<json::word>(text, at); end > at) {
    return {{at, end}, TokenKind::Name};
  }
  if (const auto end = end_of_match<json::malformed_number>(text, at); end > at) {
    return {{at, end}, TokenKind::Number};
  }
  if (end_of_match<json::curly_quote>(text, at) > at) return string(text, at);
  return {{at, end_of_any<json::token_bytes, json::token_character>(text, at)}, TokenKind::Unknown};
}

}  // namespace sdlc::lang
