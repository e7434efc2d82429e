#include "lang/json/parser.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <tao/pegtl/memory_input.hpp>
#include <tao/pegtl/normal.hpp>
#include <tao/pegtl/nothing.hpp>
#include <tao/pegtl/parse.hpp>

#include "grammar/json.hpp"
#include "lang/json/mend.hpp"
#include "lang/repair/json_repair.hpp"
#include "lang/repair/json_syntax.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

namespace grammar = grammar::json;
namespace pegtl = tao::pegtl;

/// Thrown behind the report of a mistake that cannot be read past.
struct Stopped {};

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// Whether a number too far from 1 for a double is too large, not too small: the place of its first
/// digit that is not 0 decides. Precondition: `text` is a number of JSON and not 0.
bool is_large(std::string_view text) {
  if (text.starts_with('-')) text.remove_prefix(1);
  const std::size_t e = text.find_first_of("eE");
  const std::string_view digits = text.substr(0, e);
  const std::size_t point = std::min(digits.find('.'), digits.size());
  const std::size_t first = digits.find_first_of("123456789");
  const auto place = static_cast<double>(point) - static_cast<double>(first);

  double exponent = 0;
  if (e != std::string_view::npos) {
    std::string_view power = text.substr(e + 1);
    if (power.starts_with('+')) power.remove_prefix(1);
    std::from_chars(power.data(), power.data() + power.size(), exponent);
  }
  return place + exponent > 0;
}

/// Builds the tape of each part as the grammar's actions tell, and reports what is wrong with the
/// text.
class Parser {
 public:
  /// `text` is that of the file, or of `mended`.
  Parser(const SourceFile& file, std::string_view text, const RepairedText* mended,
         std::string_view streamed, ConfigParts& parts, DiagnosticSink& sink)
      : file_(&file),
        mended_(mended),
        text_(text),
        streamed_(streamed),
        parts_(&parts),
        sink_(&sink) {}

  // What is read.

  void open(JsonNodeType type, Span bracket) {
    if (depth_ == kMaxNesting) {
      sink_->report(diag::too_deep, at(bracket), kMaxNesting);
      throw Stopped{};
    }
    if (depth_ == 0) parts_->begin(in_file(bracket));
    is_streaming_ |= depth_ == 1 && type == JsonNodeType::Array && is_streamed_name();
    open_[depth_++] = {static_cast<std::uint32_t>(tape_.size()), bracket};
    if (depth_ > 1) add(type, bracket);
  }

  void close(std::uint32_t end) {
    const Open& open = open_[--depth_];
    if (depth_ == 0) return;
    if (depth_ == 1) is_streaming_ = false;
    tape_[open.node].next = static_cast<std::uint32_t>(tape_.size());
    // What a bracket ends that is missing in the text may lack more.
    if (mended_ != nullptr && mended_->is_added(end - 1)) tape_[open.node].is_complete = false;
    tape_[open.node].span.end = in_file({end, end}).end;
  }

  void add_number(Span span) { add_number(span, text_.substr(span.begin, span.size())); }
  void add_bool(Span span, bool value) { add(JsonNodeType::Bool, span).number = value; }
  void add_null(Span span) { add(JsonNodeType::Null, span); }
  void begin_string(Span quote) {
    opening_quote_ = quote;
    has_escapes_ = false;
  }
  void note_escape() { has_escapes_ = true; }
  void add_string(Span span) {
    JsonNode& node = add(JsonNodeType::String, span);
    node.quote_size = static_cast<std::uint8_t>(opening_quote_.size());
    node.has_escapes = has_escapes_;
  }
  void begin_comment(Span opening) { opening_comment_ = opening; }
  void note_separator(std::uint32_t offset) { separator_ = offset; }

  void end_element() {
    sink_->stop_if_requested();
    if (!is_streaming_ || depth_ != 2) return;
    const std::uint32_t element = open_[1].node + 1;
    parts_->take_element(tape_, element);
    tape_.resize(element);
  }

  void end_member() {
    sink_->stop_if_requested();
    if (depth_ != 1) return;
    parts_->take_member(tape_);
    tape_.clear();
  }

  /// Hands over what was read of an unfinished part.
  void give_up() {
    const auto end = static_cast<std::uint32_t>(tape_.size());
    while (depth_ > 1) {
      JsonNode& node = tape_[open_[--depth_].node];
      node.next = end;
      node.is_complete = false;
    }
    if (tape_.size() < 2) return;
    if (is_streaming_) {
      if (tape_.size() > 2) parts_->take_element(tape_, 2);
      tape_.resize(2);
      tape_[1].next = 2;
    }
    parts_->take_member(tape_);
  }

  // What has been mended before, with a report.

  void add_mended_value(Span span) {
    if (is_of_file(span)) stop("a value", span.begin);
    add(JsonNodeType::Error, span);
  }
  /// A name in the text whose closing quote is missing, or none.
  void add_mended_name(Span span) {
    if (is_of_file(span)) stop("a key in double quotes", span.begin);
    if (span.size() == 1) {
      leave_incomplete();
      add(JsonNodeType::Error, span);
      return;
    }
    ++span.end;  // where the quote belongs
    add(JsonNodeType::String, span).quote_size = 1;
  }
  void leave_out_member(Span span) {
    if (is_of_file(span)) stop("a key in double quotes", span.begin);
    leave_incomplete();
  }
  bool is_complete() const noexcept { return is_complete_; }

  // What is read as if mended.

  void mend_number(Span span) {
    const std::string_view text = text_.substr(span.begin, span.size());
    if (names_non_finite(text)) return add_non_finite(span);
    const MendedNumber mended = lang::mend_number(text);
    auto report = sink_->report(diag::bad_number, at(span), abbreviated(text), mended.reason);
    if (!mended.text) {
      add(JsonNodeType::Error, span);
      return;
    }
    // Behind another value it may be the rest of a number.
    if (!mended.is_certain || !follows_separator(span)) {
      report.unsafe_fix(at(span), *mended.text);
    } else {
      report.fix(at(span), *mended.text);
    }
    add_number(span, *mended.text);
  }

  void mend_word(Span span) {
    const std::string_view word = text_.substr(span.begin, span.size());
    if (names_non_finite(word)) return add_non_finite(span);
    const auto literal = mend_literal(word);
    if (!literal) return mend_bare_string(span, "text without quotes is", false);
    auto report = sink_->report(diag::not_in_json, at(span), fmt::format("`{}` is", word));
    const std::string lower = lower_case(word);
    // `on` may be a word for a key that takes words.
    const bool is_certain = lower == *literal || lower == "none";
    is_certain ? report.fix(at(span), std::string(*literal))
               : report.unsafe_fix(at(span), std::string(*literal));
    if (*literal == "null") return add_null(span);
    add_bool(span, *literal == "true");
  }

  void mend_bare_string(Span span, std::string_view what, bool is_name) {
    const std::string_view word = text_.substr(span.begin, span.size());
    auto report = sink_->report(diag::not_in_json, at(span), what);
    // A value without quotes may be the name of a constant, and a quote beside a name may be its
    // own.
    const bool is_certain =
        is_name && !is_beside_quote(span) &&
        std::ranges::all_of(word, [](char c) { return is_ascii_letter(c) || c == '_'; });
    const std::string quoted = fmt::format("\"{}\"", word);
    is_certain ? report.fix(at(span), quoted) : report.unsafe_fix(at(span), quoted);
    begin_string({span.begin, span.begin});
    add_string(span);
  }

  void mend_bare_name(Span span) {
    if (text_[span.end - 1] != '"') return mend_bare_string(span, "a key without quotes is", true);
    // Its other quote is there.
    sink_->report(diag::expected, at(span), "`\"` in front of a key")
        .unsafe_fix(at({span.begin, span.begin}), "\"");
    --span.end;
    begin_string({span.begin, span.begin});
    add_string(span);
  }

  void mend_quotes(Span span, std::string_view what) {
    const std::uint32_t quote = opening_quote_.size();
    const auto content = text_.substr(span.begin + quote, span.size() - 2 * quote);
    auto report = sink_->report(diag::not_in_json, at(span), what);
    // Quotes and backslashes in it may show that it is not one text.
    const bool is_plain = content.find_first_of("\"\\'\t") == std::string_view::npos &&
                          content.find("//") == std::string_view::npos &&
                          content.find("/*") == std::string_view::npos;
    const bool is_certain = is_plain && stands_alone(span);
    is_certain ? report.fix(at(span), quote_for_json(content))
               : report.unsafe_fix(at(span), quote_for_json(content));
    has_escapes_ = content.find('\\') != std::string_view::npos;
    add_string(span);
  }

  void mend_comment(Span span) {
    sink_->report(diag::not_in_json, at(span), "comments are").unsafe_fix(at(span), "");
  }

  void mend_blank(Span span) {
    const DecodedChar c = decode_utf8(text_.substr(span.begin));
    sink_->report(diag::bad_character, at(span), describe_character(c.code_point))
        .fix(at(span), " ");
  }

  void mend_trailing_separator() {
    const Location comma = at({separator_, separator_ + 1});
    sink_->report(diag::not_in_json, comma, "a trailing comma is").fix(comma, "");
  }

  void mend_missing_name_separator(std::uint32_t offset) {
    // A name that lacks its second quote ends at the first quote of the next string, and its text
    // follows.
    if (follows_quote(offset)) stop_at_unclosed_string();
    const char next = offset < text_.size() ? text_[offset] : '\0';
    const char last = last_of_file(offset);
    const bool begins_value = next == '[' || next == '{' || next == '-' || is_ascii_digit(next);
    add_missing(":", offset, begins_value && last == '"');
  }

  void mend_missing_value_separator(std::uint32_t offset) {
    if (follows_quote(offset)) {
      sink_->report(diag::expected, gap_before(offset), "`,`")
          .help("a quote inside a string is written `\\\"`");
      throw Stopped{};
    }
    // Between `}` and `{`, or between lines, nothing else can be missing if a new item begins;
    // `1 2` may have been one number.
    const char last = last_of_file(offset);
    const Span gap{gap_before(offset).span.begin, in_file({offset, offset}).begin};
    const bool is_apart =
        last == ']' || last == '}' || file_->text(gap).find('\n') != std::string_view::npos;
    add_missing(",", offset, is_apart && begins_item(offset));
  }

  void mend_equals_sign(Span span) {
    sink_->report(diag::expected, at(span), "`:`").fix(at(span), ":");
  }

  void mend_missing_value(std::uint32_t offset) {
    const Location gap = gap_before(offset);
    sink_->report(diag::expected, gap, "a value");
    tape_.push_back({.span = gap.span,
                     .next = static_cast<std::uint32_t>(tape_.size() + 1),
                     .type = JsonNodeType::Error});
  }

  void mend_missing_member(std::uint32_t offset) {
    sink_->report(diag::expected, gap_before(offset), "a key in double quotes");
  }

  void mend_unknown_escape(Span span) {
    note_escape();
    const auto escape = text_.substr(span.begin, span.size());
    sink_->report(diag::bad_string, at(span), fmt::format("unknown escape `{}`", escape))
        .help("a backslash itself is written `\\\\`")
        .unsafe_fix(at({span.begin, span.begin + 1}), "\\\\");
  }

  void mend_short_escape(Span span) {
    note_escape();
    const auto escape = text_.substr(span.begin, span.size());
    sink_->report(diag::bad_string, at(span),
                  fmt::format("`{}` without four hexadecimal digits", escape));
  }

  void mend_lone_surrogate(Span span) {
    note_escape();
    const auto escape = text_.substr(span.begin, span.size());
    sink_->report(diag::bad_string, at(span), fmt::format("half a surrogate pair `{}`", escape));
  }

  void mend_control(Span span) {
    const auto c = static_cast<unsigned char>(text_[span.begin]);
    const bool is_tab = c == '\t';
    sink_
        ->report(diag::bad_string, at(span),
                 is_tab ? "a raw tab" : fmt::format("a raw U+{:04X}", c))
        .unsafe_fix(at(span), is_tab ? "\\t" : fmt::format("\\u{:04x}", c));
  }

  void mend_invalid_utf8(Span span) {
    // The bytes of one broken character, or of one text in another encoding, are one mistake.
    if (last_invalid_ == span.begin) {
      last_invalid_ = span.end;
      return;
    }
    last_invalid_ = span.end;
    sink_->report(diag::bad_utf8, at(span));
  }

  // What cannot be read past.

  [[noreturn]] void stop_at_unclosed_string() {
    sink_->report(diag::unclosed, at(opening_quote_),
                  text_.substr(opening_quote_.begin, opening_quote_.size()));
    throw Stopped{};
  }

  [[noreturn]] void stop_at_unclosed_comment() {
    sink_->report(diag::unclosed, at(opening_comment_), "/*");
    throw Stopped{};
  }

  [[noreturn]] void stop_at_end_of_config(std::uint32_t offset) {
    std::uint32_t end = offset;
    while (end < text_.size() && text_[end] != '\n') ++end;
    while (end > offset + 1 && is_blank(text_[end - 1])) --end;
    sink_->report(diag::text_after_end, at({offset, end}), "the config");
    throw Stopped{};
  }

  [[noreturn]] void stop(std::string_view expected, std::uint32_t offset) {
    diagnose_unexpected(expected, offset);
    throw Stopped{};
  }

 private:
  struct Open {
    std::uint32_t node = 0;  ///< none of the outermost bracket
    Span bracket;
  };

  Location at(Span span) const { return {file_, in_file(span)}; }
  Span in_file(Span span) const { return mended_ == nullptr ? span : mended_->in_source(span); }

  /// Whether the file itself has the character that stands for something mended.
  bool is_of_file(Span mark) const {
    return file_->text()[in_file(mark).begin] == text_[mark.begin];
  }
  /// What is left out of an object or of the config cannot be said to be missing.
  void leave_incomplete() {
    if (depth_ > 1) {
      tape_[open_[depth_ - 1].node].is_complete = false;
    } else {
      is_complete_ = false;
    }
  }

  /// Whether the file has a quote right before or after the span.
  bool is_beside_quote(Span span) const {
    const Span place = in_file(span);
    const std::string_view text = file_->text();
    const auto is_quote = [&](std::size_t i) { return i < text.size() && text[i] == '"'; };
    return is_quote(place.end) || (place.begin > 0 && is_quote(place.begin - 1));
  }

  bool follows_quote(std::uint32_t offset) const { return offset > 0 && text_[offset - 1] == '"'; }

  /// Whether what begins at the offset is an item of its own: a key in an object; a string, an
  /// array or an object in an array. A number or a word may belong to what stands in front of it.
  bool begins_item(std::uint32_t offset) const {
    if (depth_ == 0 || offset >= text_.size()) return false;
    const bool in_object = text_[open_[depth_ - 1].bracket.begin] == '{';
    const char c = text_[offset];
    if (c == '"') return is_key(offset) == in_object;
    return !in_object && (c == '{' || c == '[');
  }
  /// Whether a colon follows the string that begins at the offset.
  bool is_key(std::uint32_t offset) const {
    std::size_t end = std::size_t{offset} + 1;
    while (end < text_.size() && text_[end] != '"' && text_[end] != '\n') {
      if (text_[end] == '\\') ++end;
      ++end;
    }
    if (end >= text_.size() || text_[end] != '"') return false;
    const std::size_t next = text_.find_first_not_of(" \t\r\n", end + 1);
    return next != std::string_view::npos && text_[next] == ':';
  }

  /// The last character of the file before the span that is none of `blanks`; NUL if there is none.
  char last_before(Span span, std::string_view blanks) const {
    const std::string_view before = file_->text().substr(0, in_file(span).begin);
    const std::size_t last = before.find_last_not_of(blanks);
    return last == std::string_view::npos ? '\0' : before[last];
  }
  bool follows_separator(Span span) const {
    return std::string_view(",:=[(").find(last_before(span, " \t\r\n")) != std::string_view::npos;
  }
  /// Whether a text in quotes is not part of a longer one, as `'it'` is in `'it''s'`.
  bool stands_alone(Span span) const {
    const std::string_view text = file_->text();
    const std::size_t next = text.find_first_not_of(" \t", in_file(span).end);
    const bool is_ended = next == std::string_view::npos ||
                          std::string_view(":,]}\r\n").find(text[next]) != std::string_view::npos;
    const bool is_begun =
        std::string_view(",:=[{]}\n").find(last_before(span, " \t")) != std::string_view::npos;
    return is_ended && is_begun;
  }

  void add_missing(std::string_view separator, std::uint32_t offset, bool is_certain) {
    const Location gap = gap_before(offset);
    auto report = sink_->report(diag::expected, gap, fmt::format("`{}`", separator));
    is_certain ? report.fix(gap, std::string(separator))
               : report.unsafe_fix(gap, std::string(separator));
  }

  /// The empty place after the last thing before the offset, where something is missing. The file
  /// decides what a thing is: what was blanked out in `text_` is still there.
  Location gap_before(std::uint32_t offset) const {
    std::uint32_t place = in_file({offset, offset}).begin;
    while (place > 0 && is_blank(file_->text()[place - 1])) --place;
    return {file_, {place, place}};
  }
  /// The character before the gap.
  char last_of_file(std::uint32_t offset) const {
    const std::uint32_t place = gap_before(offset).span.begin;
    return place == 0 ? '\0' : file_->text()[place - 1];
  }

  bool is_streamed_name() const { return file_->text(tape_[0].content()) == streamed_; }

  JsonNode& add(JsonNodeType type, Span span) {
    // A part other than the spheres, which are streamed, has a few dozen.
    constexpr std::size_t kMaxNodes = std::size_t{1} << 24;
    if (tape_.size() == kMaxNodes) {
      sink_->report(diag::too_much_memory, at(span), kMaxNodes * sizeof(JsonNode))
          .help("only `spheres` may have so many values");
      throw Stopped{};
    }
    const auto next = static_cast<std::uint32_t>(tape_.size() + 1);
    return tape_.emplace_back(JsonNode{.span = in_file(span), .next = next, .type = type});
  }

  void add_number(Span span, std::string_view text) {
    double value = 0;
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc() || std::isinf(value)) {
      value = 0;
      if (is_large(text)) {
        sink_->report(diag::number_too_large, at(span), abbreviated(text));
        add(JsonNodeType::Error, span);
        return;
      }
    }
    add(JsonNodeType::Number, span).number = value;
  }

  void add_non_finite(Span span) {
    sink_->report(diag::bad_number, at(span), abbreviated(text_.substr(span.begin, span.size())),
                  "JSON has finite ones only");
    add(JsonNodeType::Error, span);
  }

  void diagnose_unexpected(std::string_view expected, std::uint32_t offset) {
    if (offset == text_.size()) return diagnose_unexpected_end(expected);
    // What was put in the place of a mistake has been reported.
    if (is_repair_mark(text_[offset]) && !is_of_file({offset, offset + 1})) return;
    const DecodedChar c = decode_utf8(text_.substr(offset));
    if (!c.is_valid) return diagnose_encoding(offset);

    const Location where = at({offset, offset + c.size});
    const bool is_foreign = c.code_point < 0x20 || c.code_point > 0x7E;
    if (is_foreign) {
      sink_->report(diag::bad_character, where, describe_character(c.code_point));
      return;
    }
    auto report = sink_->report(diag::expected, where, expected);
    if (depth_ == 0 || (c.code_point != ']' && c.code_point != '}')) return;
    const Span open = open_[depth_ - 1].bracket;
    const char closing = text_[open.begin] == '[' ? ']' : '}';
    if (text_[offset] == closing) return;
    report.label(at(open), fmt::format("this `{}` is still open", text_[open.begin]));
  }

  void diagnose_unexpected_end(std::string_view expected) {
    const auto end = static_cast<std::uint32_t>(text_.size());
    if (depth_ == 0) {
      sink_->report(diag::expected, at({end, end}),
                    fmt::format("{}, but the file is empty", expected));
      return;
    }
    const Span bracket = open_[depth_ - 1].bracket;
    sink_->report(diag::unclosed, at(bracket), text_.substr(bracket.begin, 1))
        .label(gap_before(end), "the file ends here");
  }

  void diagnose_encoding(std::uint32_t offset) {
    auto report = sink_->report(diag::bad_utf8, at({offset, offset + 1}));
    const bool is_utf16 = text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF");
    if (is_utf16) report.help("the file begins like UTF-16: save it as UTF-8");
  }

  const SourceFile* file_;
  const RepairedText* mended_;
  std::string_view
      text_;  ///< the spans of what is read count its bytes, those of the tape the file's
  std::string_view streamed_;
  ConfigParts* parts_;
  DiagnosticSink* sink_;

  Tape tape_;
  std::array<Open, kMaxNesting> open_;
  int depth_ = 0;
  bool is_streaming_ = false;
  bool is_complete_ = true;
  bool has_escapes_ = false;  ///< of the string being read
  Span opening_comment_;
  Span opening_quote_;           ///< likewise
  std::uint32_t separator_ = 0;  ///< where the last comma is
  std::uint32_t last_invalid_ = 0;
};

// The actions: each rule that means something tells the parser so.

template <typename Rule>
struct Action : pegtl::nothing<Rule> {};

/// An action of its own for each rule, with the span that the rule matched.
#define SDLC_JSON_ACTION(rule, statement)                                             \
  template <>                                                                         \
  struct Action<grammar::rule> {                                                      \
    template <typename Input>                                                         \
    static void apply(const Input& in, Parser& parser, const char* text) {            \
      [[maybe_unused]] const Span span{static_cast<std::uint32_t>(in.begin() - text), \
                                       static_cast<std::uint32_t>(in.end() - text)};  \
      statement;                                                                      \
    }                                                                                 \
  };

SDLC_JSON_ACTION(begin_array, parser.open(JsonNodeType::Array, span))
SDLC_JSON_ACTION(begin_object, parser.open(JsonNodeType::Object, span))
SDLC_JSON_ACTION(end_array, parser.close(span.end))
SDLC_JSON_ACTION(end_object, parser.close(span.end))
SDLC_JSON_ACTION(value_separator, parser.note_separator(span.begin))
SDLC_JSON_ACTION(present_element, parser.end_element())
SDLC_JSON_ACTION(present_member, parser.end_member())

SDLC_JSON_ACTION(number, parser.add_number(span))
SDLC_JSON_ACTION(false_, parser.add_bool(span, false))
SDLC_JSON_ACTION(true_, parser.add_bool(span, true))
SDLC_JSON_ACTION(null, parser.add_null(span))
SDLC_JSON_ACTION(opening_quote, parser.begin_string(span))
SDLC_JSON_ACTION(escape, parser.note_escape())
SDLC_JSON_ACTION(string, parser.add_string(span))

SDLC_JSON_ACTION(line_comment, parser.mend_comment(span))
SDLC_JSON_ACTION(opening_comment, parser.begin_comment(span))
SDLC_JSON_ACTION(block_comment, parser.mend_comment(span))
SDLC_JSON_ACTION(foreign_blank, parser.mend_blank(span))
SDLC_JSON_ACTION(malformed_number, parser.mend_number(span))
SDLC_JSON_ACTION(word, parser.mend_word(span))
SDLC_JSON_ACTION(mended_value, parser.add_mended_value(span))
SDLC_JSON_ACTION(mended_name, parser.add_mended_name(span))
SDLC_JSON_ACTION(mended_member, parser.leave_out_member(span))
SDLC_JSON_ACTION(bare_name, parser.mend_bare_name(span))
SDLC_JSON_ACTION(opening_single_quote, parser.begin_string(span))
SDLC_JSON_ACTION(single_quoted, parser.mend_quotes(span, "single quotes are"))
SDLC_JSON_ACTION(opening_curly_quote, parser.begin_string(span))
SDLC_JSON_ACTION(curly_quoted, parser.mend_quotes(span, "curly quotes are"))
SDLC_JSON_ACTION(lone_surrogate, parser.mend_lone_surrogate(span))
SDLC_JSON_ACTION(short_escape, parser.mend_short_escape(span))
SDLC_JSON_ACTION(unknown_escape, parser.mend_unknown_escape(span))
SDLC_JSON_ACTION(raw_control, parser.mend_control(span))
SDLC_JSON_ACTION(invalid_utf8, parser.mend_invalid_utf8(span))
SDLC_JSON_ACTION(trailing_separator, parser.mend_trailing_separator())
SDLC_JSON_ACTION(missing_value_separator, parser.mend_missing_value_separator(span.begin))
SDLC_JSON_ACTION(missing_name_separator, parser.mend_missing_name_separator(span.begin))
SDLC_JSON_ACTION(equals_sign, parser.mend_equals_sign(span))
SDLC_JSON_ACTION(missing_element, parser.mend_missing_value(span.begin))
SDLC_JSON_ACTION(missing_value, parser.mend_missing_value(span.begin))
SDLC_JSON_ACTION(missing_member, parser.mend_missing_member(span.begin))

#undef SDLC_JSON_ACTION

// The words for each commit point of the grammar.

template <typename Rule>
inline constexpr const char* kExpected = nullptr;
template <>
inline constexpr auto kExpected<grammar::object> = "an object { … }";
template <>
inline constexpr auto kExpected<grammar::first_member> = "a key in double quotes or `}`";
template <>
inline constexpr auto kExpected<grammar::member> = "a key in double quotes";
template <>
inline constexpr auto kExpected<grammar::present_member> = "a key in double quotes";
template <>
inline constexpr auto kExpected<grammar::name_separation> = "`:`";
template <>
inline constexpr auto kExpected<grammar::member_value> = "a value";
template <>
inline constexpr auto kExpected<grammar::end_object> = "`,` or `}`";
template <>
inline constexpr auto kExpected<grammar::first_element> = "a value or `]`";
template <>
inline constexpr auto kExpected<grammar::element> = "a value";
template <>
inline constexpr auto kExpected<grammar::present_element> = "a value";
template <>
inline constexpr auto kExpected<grammar::end_array> = "`,` or `]`";

template <typename Rule>
struct Control : pegtl::normal<Rule> {
  template <typename Input>
  [[noreturn]] static void raise(const Input& in, Parser& parser, const char* text) {
    const auto offset = static_cast<std::uint32_t>(in.current() - text);
    if constexpr (std::is_same_v<Rule, grammar::closing_quote> ||
                  std::is_same_v<Rule, grammar::closing_single_quote> ||
                  std::is_same_v<Rule, grammar::closing_curly_quote>) {
      parser.stop_at_unclosed_string();
    } else if constexpr (std::is_same_v<Rule, grammar::block_comment_rest>) {
      parser.stop_at_unclosed_comment();
    } else if constexpr (std::is_same_v<Rule, pegtl::eof>) {
      parser.stop_at_end_of_config(offset);
    } else {
      static_assert(kExpected<Rule> != nullptr, "a committed rule needs words for its error");
      parser.stop(kExpected<Rule>, offset);
    }
  }
};

}  // namespace

bool parse_config(const SourceFile& file, std::string_view streamed, ConfigParts& parts,
                  DiagnosticSink& sink) {
  const std::optional<RepairedText> repaired = repair_json(file, sink);
  const std::string_view text = repaired ? std::string_view(repaired->text()) : file.text();
  Parser parser(file, text, repaired ? &*repaired : nullptr, streamed, parts, sink);
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf_crlf, const char*> in(
      text.data(), text.data() + text.size(), file.name().c_str());
  try {
    return pegtl::parse<grammar::text, Action, Control>(in, parser, text.data()) &&
           parser.is_complete();
  } catch (const Stopped&) {
    parser.give_up();
    return false;
  }
}

}  // namespace sdlc::lang
