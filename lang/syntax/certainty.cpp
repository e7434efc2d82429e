#include "lang/syntax/certainty.hpp"

#include <algorithm>
#include <array>

#include "lang/schema/schema.hpp"
#include "lang/syntax/recovery.hpp"
#include "lang/syntax/vocabulary.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// Calls the function with every property and argument of the name until it returns true.
template <typename Function>
bool any_property(std::string_view name, Function is_wanted) {
  const auto has = [&](std::span<const Property> properties) {
    return std::ranges::any_of(properties, [&](const Property& property) {
      return property.name == name && is_wanted(property);
    });
  };
  return std::ranges::any_of(all_kinds(), has, &Kind::properties) ||
         std::ranges::any_of(all_materials(), has, &MaterialInfo::arguments);
}

/// Whether a value ends before `at`, blanks left out.
bool is_after_value(std::string_view text, std::uint32_t at) noexcept {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
  if (at == 0) return false;
  const char c = text[at - 1];
  if (!is_idchar(c)) {
    const std::string_view before = text.substr(0, at);
    return c == ')' || c == ']' || c == '"' || c == '\'' || c == '%' || before.ends_with("”") ||
           before.ends_with("’") || before.ends_with("°");
  }
  std::uint32_t begin = at;
  while (begin > 0 && is_idchar(text[begin - 1])) --begin;
  return !is_one_of(text.substr(begin, at - begin), kJoints) &&
         !is_one_of(text.substr(begin, at - begin), kLinkWords);
}

bool is_before_value(std::string_view text, std::uint32_t at) noexcept {
  const std::string_view rest =
      text.substr(std::min<std::size_t>(skip_blanks(text, at), text.size()));
  const char c = char_at(rest, 0);
  return is_idchar(c) ||
         (c != '\0' && std::string_view("([\"'#-.!").find(c) != std::string_view::npos) ||
         rest.starts_with("“") || rest.starts_with("‘");
}

/// Whether `let NAME` or `param NAME` ends before `at`: a value is given there, not compared.
bool is_declared_before(std::string_view text, std::uint32_t at) noexcept {
  const auto skip_back = [&](auto is_skipped) {
    while (at > 0 && is_skipped(text[at - 1])) --at;
  };
  const auto is_space = [](char c) { return c == ' ' || c == '\t'; };
  skip_back(is_space);
  skip_back(is_idchar);
  skip_back(is_space);
  const std::uint32_t end = at;
  skip_back(is_idchar);
  const std::string_view word = text.substr(at, end - at);
  return word == "let" || word == "param";
}

}  // namespace

bool is_property_name(std::string_view name) noexcept {
  return any_property(name, [](const Property&) { return true; });
}

bool is_point_property(std::string_view name) noexcept {
  const auto is_point = [](const Property& property) {
    return property.type == Type::Vec3 || property.type == Type::Angles;
  };
  const auto is_other = [&](const Property& property) { return !is_point(property); };
  return any_property(name, is_point) && !any_property(name, is_other);
}

bool is_certain_sign(std::string_view text, Span sign) noexcept {
  // `**`, `<>` and `=<` are left out: each may be a slip of the pen in another sign. So are `×` and
  // `·`: 800×600 is no product, and of vectors they are `cross` and `dot`.
  constexpr auto kBinary =
      std::to_array<std::string_view>({"&&", "||", "!==", "===", "÷", "≤", "≥", "≠", "…"});
  const std::string_view written = text.substr(sign.begin, sign.size());
  const bool has_left = is_after_value(text, sign.begin);
  const bool has_right = is_before_value(text, sign.end);
  if (is_one_of(written, kBinary)) {
    return has_left && has_right && !(written == "===" && is_declared_before(text, sign.begin));
  }
  if (written == "−") return has_right;
  if (written == "–") return has_right && !has_left;  // 1–5 may be a range
  const char next = char_at(text, sign.end), last = sign.begin > 0 ? text[sign.begin - 1] : '\0';
  return written == "!" && !has_left && last != '<' && !is_idchar(last) &&
         (is_idchar(next) || next == '(');
}

bool ends_statement(std::string_view text, std::uint32_t at) noexcept {
  const std::uint32_t begin = skip_blanks(text, at + 1);
  const std::uint32_t next = skip_space(text, at + 1);
  const char c = char_at(text, begin);
  const std::uint32_t end = end_of_identifier(text, begin);
  const bool is_property = end > begin && char_at(text, skip_blanks(text, end)) == ':';
  const bool is_next = begin >= text.size() || c == '\n' || c == '}' || next != begin ||
                       is_property || looks_like_object(text, begin) ||
                       is_one_of(text.substr(begin, end - begin), kStatementWords);
  std::uint32_t last = at;
  while (last > 0 && (text[last - 1] == ' ' || text[last - 1] == '\t')) --last;
  return is_next && (is_after_value(text, at) || (last > 0 && text[last - 1] == '}'));
}

Span closing_quote(std::string_view text, Span opening) noexcept {
  const std::string_view written = text.substr(opening.begin, opening.size());
  const bool is_single = written == "‘";
  if (!is_single && written != "“" && written != "„" && written != "”") return {};
  const std::string_view line = text.substr(0, text.find('\n', opening.end));
  std::size_t close = line.size();
  for (const std::string_view quote : {"“", "”", "’"}) {
    if ((quote == "’") == is_single) close = std::min(close, line.find(quote, opening.end));
  }
  if (close >= line.size()) return {};
  const std::string_view content = line.substr(opening.end, close - opening.end);
  const auto begin = static_cast<std::uint32_t>(close);
  return is_plain_string(content) ? Span{begin, begin + 3} : Span{};
}

bool is_plain_string(std::string_view content) noexcept {
  return content.find_first_of("\"\\\t\n\r'") == std::string_view::npos &&
         content.find("//") == std::string_view::npos &&
         content.find("/*") == std::string_view::npos;
}

}  // namespace sdlc::lang
