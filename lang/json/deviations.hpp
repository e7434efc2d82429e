#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "lang/json/near_json.hpp"
#include "lang/json/syntax_errors.hpp"
#include "lang/repair/repair_report.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {

/// Reports text that is not JSON but whose meaning is clear, with a fix, and reads it by its
/// meaning. Each function belongs to the grammar rule of the same name.
class Deviations : public SyntaxErrors {
 public:
  using SyntaxErrors::SyntaxErrors;

  void comment(Span span) {
    sink_.report(diag::not_in_json, text_.at(span), "comments are").unsafe_fix(text_.at(span), "");
  }
  void foreign_blank(Span span) {
    const DecodedChar c = decode_utf8(text_.text(span));
    sink_.report(diag::bad_character, text_.at(span), describe_character(c.code_point))
        .fix(text_.at(span), " ");
  }

  void malformed_number(Span span) {
    const std::string_view number = text_.text(span);
    if (is_non_finite(number)) return non_finite(span);
    const NearNumber meant = near_number(number);
    auto report = sink_.report(diag::bad_number, text_.at(span), abbreviated(number), meant.reason);
    if (!meant.text) {
      tape_.add(JsonNodeType::Error, span);
      return;
    }
    // After another value it may be the rest of a number.
    const char last = text_.last_before(span.begin, kJsonSpaces);
    const bool follows_separator = std::string_view(",:=[(").find(last) != std::string_view::npos;
    add_fix(report, meant.is_certain && follows_separator, text_.at(span), *meant.text);
    tape_.add_number(span, *meant.text);
  }
  void word(Span span) {
    const std::string_view word = text_.text(span);
    if (is_non_finite(word)) return non_finite(span);
    const auto literal = near_literal(word);
    if (!literal) return bare_string(span, "text without quotes is", false);
    auto report = sink_.report(diag::not_in_json, text_.at(span), fmt::format("`{}` is", word));
    // `on` may be a word for a key that takes words.
    const std::string lower = lower_case(word);
    add_fix(report, lower == *literal || lower == "none", text_.at(span), std::string(*literal));
    const bool is_null = *literal == "null";
    tape_.add(is_null ? JsonNodeType::Null : JsonNodeType::Bool, span).number = *literal == "true";
  }
  void bare_name(Span span) {
    if (text_[span.end - 1] != '"') return bare_string(span, "a key without quotes is", true);
    sink_.report(diag::expected, text_.at(span), "`\"` before a key")
        .unsafe_fix(text_.at(empty_at(span.begin)), "\"");
    --span.end;
    tape_.begin_string(empty_at(span.begin));
    tape_.add_string(span);
  }
  /// `what`: "single quotes are".
  void quoted(Span span, std::string_view what) {
    const std::uint32_t quote = tape_.opening_quote().size();
    const auto content = text_.text({span.begin + quote, span.end - quote});
    auto report = sink_.report(diag::not_in_json, text_.at(span), what);
    // Quotes, backslashes and comments in it may show that it is not one text.
    const bool is_plain = content.find_first_of("\"\\'\t") == std::string_view::npos &&
                          content.find("//") == std::string_view::npos &&
                          content.find("/*") == std::string_view::npos;
    add_fix(report, is_plain && stands_alone(span), text_.at(span), quote_for_json(content));
    if (content.find('\\') != std::string_view::npos) tape_.note_escape();
    tape_.add_string(span);
  }
  void unknown_escape(Span span) {
    tape_.note_escape();
    sink_
        .report(diag::bad_string, text_.at(span),
                fmt::format("unknown escape `{}`", text_.text(span)))
        .help("a backslash itself is written `\\\\`")
        .unsafe_fix(text_.at({span.begin, span.begin + 1}), "\\\\");
  }
  /// `format`: "half a surrogate pair `{}`".
  void bad_escape(Span span, fmt::format_string<std::string_view> format) {
    tape_.note_escape();
    sink_.report(diag::bad_string, text_.at(span), fmt::format(format, text_.text(span)));
  }
  void raw_control(Span span) {
    const auto c = static_cast<unsigned char>(text_[span.begin]);
    const bool is_tab = c == '\t';
    sink_
        .report(diag::bad_string, text_.at(span),
                is_tab ? "a raw tab" : fmt::format("a raw U+{:04X}", c))
        .unsafe_fix(text_.at(span), is_tab ? "\\t" : fmt::format("\\u{:04x}", c));
  }
  void invalid_utf8(Span span) {
    // Adjacent bytes are one mistake: a broken character, or a text in another encoding.
    if (last_invalid_ != span.begin) sink_.report(diag::bad_utf8, text_.at(span));
    last_invalid_ = span.end;
  }

  void note_separator(std::uint32_t offset) noexcept { separator_ = offset; }
  void trailing_separator() {
    const Location comma = text_.at({separator_, separator_ + 1});
    sink_.report(diag::not_in_json, comma, "a trailing comma is").fix(comma, "");
  }
  void missing_name_separator(std::uint32_t offset) {
    // A name without its closing quote ends at the first quote of the next string, whose text
    // follows.
    if (offset > 0 && text_[offset - 1] == '"') unclosed_string();
    const char next = text_[offset];
    const bool begins_value = next == '[' || next == '{' || next == '-' || is_ascii_digit(next);
    missing(":", offset, begins_value && text_.last_before(offset, kJsonSpaces) == '"');
  }
  void missing_value_separator(std::uint32_t offset) {
    const Location gap = text_.gap_before(offset);
    if (offset > 0 && text_[offset - 1] == '"') {
      sink_.report(diag::expected, gap, "`,`").help("a quote inside a string is written `\\\"`");
      throw JsonAbandoned{};
    }
    // If a new item begins after a bracket or on another line, only a comma can be missing. `1 2`
    // may have been one number.
    const char last = text_.last_before(offset, kJsonSpaces);
    const Span space{gap.span.begin, text_.in_file(empty_at(offset)).begin};
    const bool is_apart =
        last == ']' || last == '}' || text_.file().text(space).find('\n') != std::string_view::npos;
    missing(",", offset, is_apart && begins_item(offset));
  }
  void equals_sign(Span span) {
    sink_.report(diag::expected, text_.at(span), "`:`").fix(text_.at(span), ":");
  }
  void missing_value(std::uint32_t offset) {
    const Location gap = text_.gap_before(offset);
    sink_.report(diag::expected, gap, "a value");
    tape_.add_missing(gap.span);
  }
  void missing_member(std::uint32_t offset) {
    sink_.report(diag::expected, text_.gap_before(offset), "a key in double quotes");
  }

  // Marks of lang/repair, which has reported the mistake.
  void repaired_value(Span mark) {
    if (text_.is_of_file(mark.begin)) expected("a value", mark.begin);
    tape_.add(JsonNodeType::Error, mark);
  }
  /// `span`: the mark and the rest of a name without closing quote, if there is one.
  void repaired_name(Span span) {
    if (text_.is_of_file(span.begin)) expected("a key in double quotes", span.begin);
    if (span.size() == 1) {
      tape_.leave_incomplete();
      tape_.add(JsonNodeType::Error, span);
      return;
    }
    ++span.end;  // where the quote belongs
    tape_.add(JsonNodeType::String, span).quote_size = 1;
  }
  void repaired_member(Span mark) {
    if (text_.is_of_file(mark.begin)) expected("a key in double quotes", mark.begin);
    tape_.leave_incomplete();
  }

 private:
  void non_finite(Span span) {
    sink_.report(diag::bad_number, text_.at(span), abbreviated(text_.text(span)),
                 "JSON numbers are finite");
    tape_.add(JsonNodeType::Error, span);
  }
  void bare_string(Span span, std::string_view what, bool is_name) {
    const std::string_view word = text_.text(span);
    auto report = sink_.report(diag::not_in_json, text_.at(span), what);
    // A value may be the name of a constant, and a quote beside a key may belong to it.
    const bool is_certain =
        is_name && !is_beside_quote(span) &&
        std::ranges::all_of(word, [](char c) { return is_ascii_letter(c) || c == '_'; });
    add_fix(report, is_certain, text_.at(span), fmt::format("\"{}\"", word));
    tape_.begin_string(empty_at(span.begin));
    tape_.add_string(span);
  }
  void missing(std::string_view separator, std::uint32_t offset, bool is_certain) {
    const Location gap = text_.gap_before(offset);
    auto report = sink_.report(diag::expected, gap, fmt::format("`{}`", separator));
    add_fix(report, is_certain, gap, std::string(separator));
  }

  static constexpr Span empty_at(std::uint32_t offset) { return {offset, offset}; }
  /// Whether a colon follows the string at the beginning of the text.
  static bool is_key(std::string_view text) {
    std::size_t end = 1;
    while (end < text.size() && text[end] != '"' && text[end] != '\n') {
      end += text[end] == '\\' ? 2 : 1;
    }
    if (end >= text.size() || text[end] != '"') return false;
    const std::size_t next = text.find_first_not_of(kJsonSpaces, end + 1);
    return next != std::string_view::npos && text[next] == ':';
  }
  /// Whether the file has a double quote directly before or after the span.
  bool is_beside_quote(Span span) const {
    const Span place = text_.in_file(span);
    const std::string_view file = text_.file().text();
    return file.substr(place.end).starts_with('"') || file.substr(0, place.begin).ends_with('"');
  }
  /// Whether a quoted text is a whole value or key, unlike `'it'` in `'it''s'`.
  bool stands_alone(Span span) const {
    const std::string_view file = text_.file().text();
    const std::size_t next = file.find_first_not_of(" \t", text_.in_file(span).end);
    const bool is_ended = next == std::string_view::npos ||
                          std::string_view(":,]}\r\n").find(file[next]) != std::string_view::npos;
    const char last = text_.last_before(span.begin, " \t");
    return is_ended && std::string_view(",:=[{]}\n").find(last) != std::string_view::npos;
  }
  /// Whether a separate item begins at the offset: a key in an object; a string, an array or an
  /// object in an array. A number or a word may belong to the text before it.
  bool begins_item(std::uint32_t offset) const {
    const auto open = tape_.open_bracket();
    if (!open) return false;
    const bool in_object = text_[open->begin] == '{';
    const char c = text_[offset];
    if (c == '"') return is_key(text_.text().substr(offset)) == in_object;
    return !in_object && (c == '{' || c == '[');
  }

  std::uint32_t separator_ = 0;     ///< offset of the last comma
  std::uint32_t last_invalid_ = 0;  ///< end of the last invalid bytes
};

}  // namespace sdlc::lang
