#pragma once

#include <cstdint>
#include <string_view>

#include <fmt/format.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/json/parsed_text.hpp"
#include "lang/json/tape_builder.hpp"
#include "lang/repair/json_syntax.hpp"
#include "lang/text/brackets.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {

/// Reports the mistakes after which the parse cannot continue, and ends it.
class SyntaxErrors {
 public:
  SyntaxErrors(const ParsedText& text, TapeBuilder& tape, DiagnosticSink& sink)
      : text_(text), tape_(tape), sink_(sink) {}

  [[noreturn]] void expected(std::string_view what, std::uint32_t offset) const {
    report_unexpected(what, offset);
    throw JsonAbandoned{};
  }
  [[noreturn]] void unclosed_string() const {
    const Span quote = tape_.opening_quote();
    sink_.report(diag::unclosed, text_.at(quote), text_.text(quote));
    throw JsonAbandoned{};
  }
  [[noreturn]] void unclosed_comment(Span opening) const {
    sink_.report(diag::unclosed, text_.at(opening), "/*");
    throw JsonAbandoned{};
  }
  [[noreturn]] void text_after_config(std::uint32_t offset) const {
    std::string_view line = text_.text().substr(offset);
    line = line.substr(0, line.find('\n'));
    const auto size = static_cast<std::uint32_t>(line.find_last_not_of(kJsonSpaces) + 1);
    sink_.report(diag::text_after_end, text_.at({offset, offset + size}), "the config");
    throw JsonAbandoned{};
  }

 protected:
  const ParsedText& text_;
  TapeBuilder& tape_;
  DiagnosticSink& sink_;

 private:
  void report_unexpected(std::string_view wanted, std::uint32_t offset) const {
    const std::string_view text = text_.text();
    if (offset == text.size()) return report_unexpected_end(wanted);
    // The repair that left a mark has been reported.
    if (is_repair_mark(text[offset]) && !text_.is_of_file(offset)) return;
    const DecodedChar c = decode_utf8(text.substr(offset));
    const Location where = text_.at({offset, offset + c.size});
    if (!c.is_valid) {
      const bool is_utf16 = text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
      sink_.report(diag::bad_utf8, where)
          .help_if(is_utf16 ? "the file begins like UTF-16: save it as UTF-8" : "");
      return;
    }
    if (c.code_point < 0x20 || c.code_point > 0x7E) {
      sink_.report(diag::bad_character, where, describe_character(c.code_point));
      return;
    }
    auto report = sink_.report(diag::expected, where, wanted);
    const auto open = tape_.open_bracket();
    if (!open || (text[offset] != ']' && text[offset] != '}')) return;
    if (is_bracket_pair(text[open->begin], text[offset])) return;
    report.label(text_.at(*open), fmt::format("this `{}` is still open", text[open->begin]));
  }
  void report_unexpected_end(std::string_view wanted) const {
    const auto end = static_cast<std::uint32_t>(text_.text().size());
    if (const auto bracket = tape_.open_bracket()) {
      sink_.report(diag::unclosed, text_.at(*bracket), text_.text(*bracket))
          .label(text_.gap_before(end), "the file ends here");
    } else {
      sink_.report(diag::expected, text_.at({end, end}),
                   fmt::format("{}, but the file is empty", wanted));
    }
  }
};

}  // namespace sdlc::lang
