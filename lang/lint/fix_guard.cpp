#include "lang/lint/fix_guard.hpp"

#include <algorithm>
#include <cstdint>

#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// Whether the fix changes only a part of a sign such as `:=` or `=>`.
bool splits_sign(std::string_view text, const Fix& fix) {
  constexpr std::string_view kSigns = "=:<>!&|*%^~?";
  const auto is_sign = [&](std::size_t at) {
    return at < text.size() && kSigns.find(text[at]) != std::string_view::npos;
  };
  auto [begin, end] = fix.where.span;
  while (begin < end && text[begin] == ' ') ++begin;
  if (begin == end || !is_sign(begin) || !is_sign(end - 1)) return false;
  if (is_sign(end) || (begin > 0 && is_sign(begin - 1))) return true;
  // `= =` is one mistake, `&& !` two signs.
  const auto is_equals = [&](std::size_t at) {
    return at < text.size() && (text[at] == '=' || text[at] == ':');
  };
  if (!is_equals(begin)) return false;
  while (begin > 0 && text[begin - 1] == ' ') --begin;
  while (end < text.size() && text[end] == ' ') ++end;
  return is_equals(end) || (begin > 0 && is_equals(begin - 1));
}

/// Whether the fix joins its replacement to an adjacent word. A unit belongs directly after its
/// number.
bool joins_words(std::string_view text, const Fix& fix) {
  const auto [begin, end] = fix.where.span;
  const std::string& written = fix.replacement;
  if (written.empty()) return false;
  const auto is_word = [](char c) { return is_idchar(c) || static_cast<unsigned char>(c) >= 0x80; };
  const bool begins_with_word = begin < end && is_idchar(text[begin]);
  const bool ends_with_word = begin < end && is_idchar(text[end - 1]);
  const bool is_unit = written == "deg" && begin > 0 && is_digit(text[begin - 1]);
  const bool before = begin > 0 && is_word(text[begin - 1]) && is_idchar(written.front());
  const bool after = end < text.size() && is_word(text[end]) && is_idchar(written.back());
  return (before && !begins_with_word && !is_unit) || (after && !ends_with_word);
}

constexpr std::string_view kForeignQuotes[] = {"'", "“", "”", "„", "‘", "’"};

/// Whether the fix is inside quotes of another language, or writes a quote where such quotes do not
/// form plain pairs, so that the extent of the string is uncertain.
bool is_among_quotes(std::string_view text, const Fix& fix) {
  const std::size_t at_fix = fix.where.span.begin;
  const std::size_t begin = at_fix == 0 ? 0 : text.rfind('\n', at_fix - 1) + 1;
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  const auto starts_at_fix = [&](std::string_view quote) {
    return text.substr(at_fix).starts_with(quote);
  };
  const bool is_quote =
      std::ranges::any_of(kForeignQuotes, starts_at_fix);  // a closing one is inside
  std::size_t before = 0, all = 0;
  bool touches_word = false;
  for (std::size_t at = begin; at < end; ++at) {
    for (const std::string_view quote : kForeignQuotes) {
      if (!text.substr(at).starts_with(quote)) continue;
      ++all;
      if (at < at_fix) ++before;
      const bool opens = all % 2 == 1;
      if (opens ? at == begin : at + quote.size() == end) continue;
      const char beside = opens ? text[at - 1] : text[at + quote.size()];
      touches_word |=
          is_idchar(beside) || beside == '\'' || static_cast<unsigned char>(beside) >= 0x80;
    }
  }
  const bool writes_quote = fix.replacement.find('"') != std::string::npos;
  return (!is_quote && before % 2 == 1) ||
         (writes_quote && all > 0 && (all % 2 == 1 || touches_word));
}

bool is_line_comment(std::string_view opaque) { return opaque.starts_with("//"); }
bool is_quoted(std::string_view opaque) { return opaque.starts_with('"'); }

/// Whether the string or comment ends with its own delimiter, so that text after it is outside.
bool is_closed(std::string_view opaque) {
  if (is_quoted(opaque)) return opaque.size() > 1 && opaque.ends_with('"');
  return !is_line_comment(opaque) && opaque.ends_with("*/");
}

}  // namespace

FixGuard::FixGuard(std::string_view text) : text_(text) {
  TokenReader tokens(text);
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (is_comment(token.kind) || is_string(token.kind)) opaque_.push_back(token.span);
  }
}

bool FixGuard::allows(const Fix& fix) const {
  return keeps_strings_and_comments(fix) && !splits_sign(text_, fix) && !joins_words(text_, fix) &&
         !is_among_quotes(text_, fix);
}

bool FixGuard::keeps_strings_and_comments(const Fix& fix) const {
  const Span changed = fix.where.span;
  const auto first = std::ranges::lower_bound(opaque_, changed.begin, {}, &Span::end);
  const auto last = std::ranges::upper_bound(opaque_, changed.end, {}, &Span::begin);
  return std::all_of(first, last, [&](Span span) { return keeps(span, fix); });
}

bool FixGuard::keeps(Span span, const Fix& fix) const {
  const Span changed = fix.where.span;
  const std::string_view opaque = text_.substr(span.begin, span.size());
  if (changed.end <= span.begin) return true;
  // An insertion after an open end becomes a part of it.
  if (changed.begin >= span.end) return changed.begin > span.end || is_closed(opaque);
  const bool is_whole = changed.begin <= span.begin && changed.end >= span.end;
  const std::size_t quote = is_quoted(opaque) ? 1 : 0;
  return is_whole && is_closed(opaque) &&
         fix.replacement.find(opaque.substr(quote, opaque.size() - 2 * quote)) != std::string::npos;
}

}  // namespace sdlc::lang
