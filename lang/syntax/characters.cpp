#include "lang/syntax/characters.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "lang/text/utf8.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

bool is_bidi_control(char32_t c) noexcept {
  return c == 0x061C || c == 0x200E || c == 0x200F || (c >= 0x202A && c <= 0x202E) ||
         (c >= 0x2066 && c <= 0x2069);
}

/// A Unicode space, or a character of zero width.
bool is_unicode_space(char32_t c) noexcept {
  return c == 0xA0 || c == 0x1680 || (c >= 0x2000 && c <= 0x200D) || c == 0x2028 || c == 0x2029 ||
         c == 0x202F || c == 0x205F || c == 0x2060 || c == 0x3000 || c == 0xFEFF || c == 0x85;
}

bool is_control(char32_t c) noexcept {
  return (c < 0x20 && c != '\t' && c != '\n') || (c >= 0x7F && c < 0xA0 && c != 0x85);
}

/// The first byte from `at` on that is not printable ASCII, tab or LF.
std::uint32_t next_special(std::string_view text, std::uint32_t at) noexcept {
  constexpr std::uint64_t kOnes = 0x0101010101010101, kHighs = 0x8080808080808080;
  const auto is_plain = [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\t'; };
  while (at < text.size()) {
    // SWAR: eight bytes at once while none is below U+0020 or above U+007E.
    while (at + 8 <= text.size()) {
      std::uint64_t word;
      std::memcpy(&word, text.data() + at, 8);
      const std::uint64_t below = (word - kOnes * 0x20) & ~word;
      const std::uint64_t above = word | (word + kOnes);
      if (((below | above) & kHighs) != 0) break;
      at += 8;
    }
    const std::size_t end = std::min<std::size_t>(text.size(), at + 8);
    for (; at < end; ++at) {
      if (!is_plain(text[at])) return at;
    }
  }
  return at;
}

/// Whether the text has a byte order mark of UTF-16, or every other of its first bytes is NUL.
bool is_utf16(std::string_view text) noexcept {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) return true;
  constexpr std::size_t kMaxBytes = 64, kMinBytes = 8;
  const std::string_view beginning = text.substr(0, std::min(text.size(), kMaxBytes));
  std::array<std::size_t, 2> zeros{};
  for (std::size_t i = 0; i < beginning.size(); ++i) zeros[i % 2] += beginning[i] == '\0';
  const auto [fewer, more] = std::minmax(zeros[0], zeros[1]);
  return beginning.size() >= kMinBytes && fewer == 0 && more * 2 + 1 >= beginning.size();
}

class CharacterCheck {
 public:
  CharacterCheck(const SourceFile& file, DiagnosticSink& sink)
      : file_(file), text_(file.text()), sink_(sink), tokens_(text_) {}

  std::optional<std::string> run() {
    if (is_utf16(text_)) {
      sink_.report(diag::bad_utf8, {&file_, {0, 2}}).help("this is UTF-16; save the file as UTF-8");
      std::string empty(text_.size(), ' ');
      if (empty.size() >= 7) empty.replace(0, 7, "scene 1");
      return empty;
    }
    std::uint32_t at = text_.starts_with("\xEF\xBB\xBF") ? 3 : 0;
    while ((at = next_special(text_, at)) < text_.size()) {
      sink_.stop_if_requested();
      at = check(at);
    }
    return std::move(repaired_);
  }

 private:
  std::uint32_t check(std::uint32_t at) {
    if (text_[at] == '\r' && char_at(text_, at + 1) == '\n') return at + 2;
    const DecodedChar c = decode_utf8(text_.substr(at));
    const Span span{at, at + c.size};
    if (!c.is_valid) return bad_bytes(at);
    if (c.code_point == '\r') {
      replace(span, '\n');
      if (!has_lone_return_) {
        sink_.report(diag::bad_character, {&file_, span}, "a carriage return without a line feed")
            .help("save the file with LF or CRLF line ends");
      }
      has_lone_return_ = true;
    } else if (is_control(c.code_point) || is_bidi_control(c.code_point)) {
      const char* what =
          is_bidi_control(c.code_point) ? "a control of text direction" : "a control character";
      return report(at, c, what, "");
    } else if (is_unicode_space(c.code_point) && !is_opaque(at)) {
      return report(at, c, "a space other than U+0020", " ");
    }
    return span.end;
  }

  std::uint32_t bad_bytes(std::uint32_t at) {
    std::uint32_t end = at + 1;
    while (end < text_.size() && !decode_utf8(text_.substr(end)).is_valid) ++end;
    sink_.report(diag::bad_utf8, {&file_, {at, end}}).help("save the file as UTF-8");
    replace({at, end}, ' ');
    return end;
  }

  /// Reports a run of one character once; returns its end.
  std::uint32_t report(std::uint32_t at, DecodedChar c, std::string_view what,
                       std::string_view replacement) {
    const std::string_view character = text_.substr(at, c.size);
    std::string fix;
    Span run{at, at};
    for (; text_.substr(run.end).starts_with(character); run.end += c.size) fix += replacement;
    auto report =
        sink_.report(diag::bad_character, {&file_, run},
                     fmt::format("U+{:04X}, {},", static_cast<std::uint32_t>(c.code_point), what));
    const bool is_in_word =
        at > 0 && is_idchar(text_[at - 1]) && is_idchar(char_at(text_, run.end));
    if (is_in_word || is_opaque(at)) {
      report.unsafe_fix({&file_, run}, std::move(fix));
    } else {
      report.fix({&file_, run}, std::move(fix));
    }
    replace(run, ' ');
    return run.end;
  }

  void replace(Span span, char replacement) {
    if (!repaired_) repaired_ = text_;
    for (std::uint32_t i = span.begin; i < span.end; ++i) (*repaired_)[i] = replacement;
  }

  /// Whether `at` lies in a comment or string. Asked in the order of the text.
  bool is_opaque(std::uint32_t at) {
    while (token_.span.end <= at) {
      sink_.stop_if_requested();
      token_ = tokens_.next();
    }
    return is_comment(token_.kind) || is_string(token_.kind);
  }

  const SourceFile& file_;
  std::string_view text_;
  DiagnosticSink& sink_;
  std::optional<std::string> repaired_;
  TokenReader tokens_;
  Token token_;  ///< the last one that was read
  bool has_lone_return_ = false;
};

}  // namespace

std::optional<std::string> check_characters(const SourceFile& file, DiagnosticSink& sink) {
  return CharacterCheck(file, sink).run();
}

}  // namespace sdlc::lang
