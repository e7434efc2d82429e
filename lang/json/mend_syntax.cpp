#include "lang/json/mend_syntax.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "lang/json/config_scan.hpp"
#include "lang/json/value_extent.hpp"
#include "lang/source/limits.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Walks through a config line by line. Every byte is looked at a fixed number of times.
class Mender {
 public:
  Mender(const SourceFile& file, DiagnosticSink& sink)
      : file_(file), sink_(sink), text_(file.text()), scan_(text_), extents_(scan_) {}

  std::optional<std::string> run() {
    constexpr std::string_view kMarks("\x1A\x1C\x1D", 3);
    const bool is_ours =
        text_.size() <= kMaxMendedText && text_.find_first_of(kMarks) == std::string_view::npos;
    if (!is_ours || !skip_space() || text_[at_] != '{') return std::nullopt;
    open();
    while (!is_done_ && skip_space()) step();
    return std::move(mended_);
  }

 private:
  enum class State : std::uint8_t { Item, Value, After };
  struct Open {
    char bracket;
    std::uint32_t at;
  };

  Location where(std::uint32_t begin, std::uint32_t end) const { return {&file_, {begin, end}}; }
  bool in_object() const { return open_.back().bracket == '{'; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(text_.size()); }

  /// Past blanks and comments; false at the end, and where a comment is never closed.
  bool skip_space() {
    while (at_ < text_.size()) {
      if (is_one_of(text_[at_], " \t\r\n")) {
        ++at_;
      } else if (const std::uint32_t blank = scan_.foreign_blank(at_); blank != 0) {
        at_ += blank;
      } else if ((text_[at_] == '#' && !is_color(at_)) ||
                 (text_[at_] == '/' && scan_.at(at_ + 1) == '/')) {
        at_ = static_cast<std::uint32_t>(std::min(text_.find('\n', at_), text_.size()));
      } else if (text_[at_] == '/' && scan_.at(at_ + 1) == '*') {
        const std::size_t end = text_.find("*/", at_ + 2);
        if (end == std::string_view::npos) return false;
        at_ = static_cast<std::uint32_t>(end + 2);
      } else {
        return true;
      }
    }
    return false;
  }

  /// A colour of the web where a value belongs, not a comment.
  bool is_color(std::uint32_t i) const {
    const bool may_be_value =
        state_ == State::Value || (state_ == State::Item && !open_.empty() && !in_object());
    return may_be_value && scan_.is_web_color(i);
  }

  // What is put in place.

  std::string& mended() {
    if (!mended_) mended_.emplace(text_);
    return *mended_;
  }
  void put(std::uint32_t begin, std::uint32_t end, char mark) {
    std::string& text = mended();
    std::fill(text.begin() + begin, text.begin() + end, ' ');
    if (mark != ' ') text[begin] = mark;
  }

  void unexpected(std::string_view expected, std::uint32_t i) {
    const DecodedChar c = decode_utf8(text_.substr(i));
    if (!c.is_valid) {
      sink_.report(diag::bad_utf8, where(i, i + 1));
    } else if (c.code_point < 0x20 || c.code_point > 0x7E) {
      sink_.report(diag::bad_character, where(i, i + c.size), describe_character(c.code_point));
    } else {
      sink_.report(diag::expected, where(i, i + 1), expected);
    }
  }
  void unclosed(std::uint32_t quote, std::uint32_t end) {
    const std::string mark(text_.substr(quote, scan_.quote_size(quote)));
    sink_.report(diag::unclosed, where(quote, quote + scan_.quote_size(quote)), mark)
        .unsafe_fix(where(end, end), mark.size() == 1 ? mark : "\u201D");
  }

  // The walk.

  void step() {
    const char c = text_[at_];
    if (c == ']' || c == '}') return close();
    if (c == ')') return close_round();
    if (c == ',') {
      ++at_;
      is_first_ = false;
      state_ = State::Item;
      return;
    }
    switch (state_) {
      case State::After: return read_after();
      case State::Value: return read_value();
      case State::Item:
        if (c == '{' || c == '[') return open();
        if (!in_object() && is_key_ahead()) {
          while (open_.size() > 1 && !in_object()) open_.pop_back();
        }
        return in_object() ? read_key() : read_value();
    }
  }

  void open() {
    open_.push_back({text_[at_], at_});
    ++at_;
    is_first_ = true;
    state_ = State::Item;
  }

  void close() {
    const char opening = text_[at_] == ']' ? '[' : '{';
    ++at_;
    state_ = State::After;
    const std::size_t depth = open_.size();
    const auto fits = [&](std::size_t i) {
      return depth > i && open_[depth - 1 - i].bracket == opening;
    };
    const std::size_t count = fits(0) ? 1 : fits(1) ? 2 : 0;
    if (count < depth) {
      open_.resize(depth - count);
      return;
    }
    // The config goes on where its closing bracket is one too many.
    open_.resize(1);
    is_done_ = !is_one_of(scan_.at(scan_.skip_lines(at_)), ",]}\"");
  }

  void close_round() {
    const Open opened = open_.back();
    const char closing = opened.bracket == '[' ? ']' : '}';
    const Location place = where(at_, at_ + 1);
    if (open_.size() == 1 || scan_.at(scan_.skip_blanks(at_ + 1)) == closing) {
      sink_.report(diag::unmatched, place, ")").unsafe_fix(place, "");
      put(at_, at_ + 1, ' ');
      ++at_;
      return;
    }
    sink_.report(diag::expected, place, fmt::format("`{}`, found `)`", closing))
        .label(where(opened.at, opened.at + 1), "opened here")
        .unsafe_fix(place, std::string(1, closing));
    put(at_, at_ + 1, closing);
    open_.pop_back();
    ++at_;
    state_ = State::After;
  }

  /// A key where a value belongs, in the line of the key before it.
  bool lacks_brace() const {
    std::uint32_t colon = at_;
    while (colon > 0 && is_one_of(text_[colon - 1], " \t")) --colon;
    return in_object() && colon > 0 && text_[colon - 1] == ':' && is_key_ahead();
  }

  bool is_key_ahead() const {
    std::uint32_t end = 0;
    if (scan_.begins_string(at_)) {
      end = scan_.end_of_string(at_);
    } else if (is_ascii_letter(text_[at_])) {
      end = scan_.end_of_word(at_);
    }
    return end != 0 && scan_.is_label_end(end);
  }

  // Keys.

  /// A key whose quotes have slipped: ""key", k"ey" or "ke"y.
  bool read_slipped_key() {
    const std::uint32_t begin = at_;
    std::uint32_t end = begin;
    std::string key = "\"";
    for (; end < size() && (text_[end] == '"' || is_word(text_[end])); ++end) {
      if (text_[end] != '"') key += text_[end];
    }
    key += '"';
    const std::string_view written = text_.substr(begin, end - begin);
    const bool is_slipped = key.size() > 2 && written.size() >= key.size() && written != key;
    if (!is_slipped || !scan_.is_label_end(end)) return false;
    sink_.report(diag::expected, where(begin, end), fmt::format("`{}`, found `{}`", key, written))
        .unsafe_fix(where(begin, end), key);
    key.resize(written.size(), ' ');
    mended().replace(begin, key.size(), key);
    read_separator(begin, end);
    return true;
  }

  void read_key() {
    if (read_slipped_key()) return;
    const std::uint32_t begin = at_;
    if (scan_.begins_string(begin)) return read_quoted_key();
    const std::uint32_t colon = end_of_name(begin);
    const bool has_colon = is_one_of(scan_.at(colon), ":=");
    if (is_ascii_letter(text_[begin])) {
      std::uint32_t end = scan_.end_of_word(begin);
      if (scan_.at(end) == '"') ++end;
      const std::uint32_t next = scan_.skip_blanks(end);
      if (is_one_of(scan_.at(next), ":=") || !has_colon) return read_separator(begin, end);
      // Several words.
      std::uint32_t last = colon;
      while (is_one_of(text_[last - 1], " \t")) --last;
      const auto words = text_.substr(begin, last - begin);
      sink_.report(diag::not_in_json, where(begin, last), "a key without quotes is")
          .unsafe_fix(where(begin, last), fmt::format("\"{}\"", words));
      put(begin, last, kMendedName);
      return read_separator(begin, last);
    }
    if (has_colon && colon > begin) {
      expected_key(begin);
      put(begin, colon, kMendedName);
      return read_separator(begin, colon);
    }
    if (scan_.begins_word(begin)) {  // perhaps of an array whose bracket is missing
      at_ = scan_.end_of_word(begin);
      state_ = State::After;
      return;
    }
    expected_key(begin);
    drop_member(begin, std::max(colon, begin + 1));
  }

  /// The colon behind a name of several words, or where there can be none any more.
  std::uint32_t end_of_name(std::uint32_t i) {
    if (i >= name_end_) {
      for (name_end_ = i; !scan_.ends_line(name_end_); ++name_end_) {
        if (is_one_of(text_[name_end_], ",{}[]\":=")) break;
      }
    }
    return name_end_;
  }

  void expected_key(std::uint32_t begin) {
    unexpected(is_first_ ? "a key in double quotes or `}`" : "a key in double quotes", begin);
  }

  void drop_member(std::uint32_t begin, std::uint32_t end) {
    put(begin, end, kMendedMember);
    at_ = end;
    state_ = State::After;
  }

  void read_quoted_key() {
    const std::uint32_t begin = at_;
    const std::uint32_t end = scan_.end_of_string(begin);
    if (end != 0 && is_one_of(scan_.at(scan_.skip_lines(end)), ":="))
      return read_separator(begin, end);

    std::uint32_t word_end = begin + scan_.quote_size(begin);
    while (is_word(scan_.at(word_end))) ++word_end;
    if (word_end > begin + 1 && text_[begin] == '"' && scan_.is_label_end(word_end)) {
      unclosed(begin, word_end);
      put(begin, begin + 1, kMendedName);
      return read_separator(begin, word_end);
    }
    if (text_[begin] == '\'' && scan_.at(word_end) == '"' && scan_.is_label_end(word_end + 1)) {
      const auto word = text_.substr(begin + 1, word_end - begin - 1);
      const Location place = where(begin, word_end + 1);
      sink_.report(diag::not_in_json, place, "single quotes are")
          .unsafe_fix(place, fmt::format("\"{}\"", word));
      put(begin, begin + 1, '"');
      return read_separator(begin, word_end + 1);
    }
    if (end != 0) return read_separator(begin, end);
    const std::uint32_t last = scan_.end_of_unclosed(begin);
    unclosed(begin, last);
    drop_member(begin, last);
  }

  void read_separator(std::uint32_t begin, std::uint32_t end) {
    at_ = end;
    if (!skip_space()) return;
    const std::uint32_t found = at_;
    const char c = text_[found];
    state_ = State::Value;
    if (c == ':' || c == '=') {
      ++at_;
      if (c == '=' && is_one_of(scan_.at(at_), "=>")) put(at_, at_ + 1, ' ');
      return;
    }
    if (c == '{' || c == '[' || scan_.begins_string(found) ||
        (scan_.begins_word(found) && found > end))
      return;
    if (is_one_of(c, ",}]")) {
      // Without its brackets an array is a row of strings.
      unexpected("`:`", found);
      put(begin, end, kMendedMember);
      state_ = State::After;
      return;
    }
    std::uint32_t last = found;
    while (!scan_.ends_line(last) && !scan_.begins_word(last) && !scan_.begins_string(last) &&
           !is_one_of(text_[last], " \t,{}[]")) {
      ++last;
    }
    unexpected("`:`", found);
    if (last == found) return drop_member(begin, std::max(scan_.end_of_word(found), found + 1));
    put(found, last, ':');
    at_ = last;
  }

  // Values.

  void read_value() {
    const std::uint32_t begin = at_;
    const char c = text_[begin];
    if (c == '{' || c == '[') return open();
    if (c == '(' && read_round_list()) return;
    if (c == '#') return replace_color();
    if (lacks_brace()) {
      // Whoever repairs the brackets says so.
      open_.push_back({'{', begin});
      is_first_ = true;
      state_ = State::Item;
      return;
    }
    if (is_one_of(c, ":=;")) {
      unexpected("a value", begin);
      put(begin, begin + 1, c == ';' ? kMendedValue : ' ');
      ++at_;
      if (c == ';') state_ = State::After;
      return;
    }

    const ValueExtent extent = extents_.measure(begin);
    const std::uint32_t end = std::max(extent.end, begin + 1);
    const bool is_in_row = !in_object() || extent.things == 1;
    if (extent.odd == 0 && !extent.is_unclosed && !extent.lacks_quote && is_in_row &&
        extent.inner_quote == 0) {
      at_ = end;
      state_ = State::After;
      return;
    }
    diagnose_value(begin, extent);
    if (extent.things == 0 && is_one_of(scan_.at(scan_.skip_blanks(end)), "{[")) {
      put(begin, end, ' ');
      at_ = end;
      return;
    }
    put(begin, end, kMendedValue);
    at_ = end;
    state_ = State::After;
  }

  void diagnose_value(std::uint32_t begin, const ValueExtent& extent) {
    if (extent.is_unclosed) return unclosed(begin, extent.end);
    if (extent.lacks_quote) {
      sink_.report(diag::expected, where(begin, extent.end), "`\"` in front of a text")
          .unsafe_fix(where(begin, begin), "\"");
      return;
    }
    if (extent.things == 0) return unexpected("a value", begin);
    if (extent.inner_quote != 0) {
      sink_.report(diag::expected, where(extent.inner_quote, extent.inner_quote), "`,`")
          .help("a quote inside a string is written `\\\"`");
      return;
    }
    if (extent.odd == 0) {
      sink_.report(diag::expected, where(extent.first_end, extent.first_end),
                   in_object() ? "`,` or `}`" : "`,` or `]`");
      return;
    }
    sink_.report(diag::not_in_json, where(begin, extent.end), "calculations are")
        .help("write the result");
  }

  void replace_color() {
    const std::uint32_t begin = at_;
    while (is_hex_digit(scan_.at(++at_))) {
    }
    sink_.report(diag::not_in_json, where(begin, at_), "a colour with `#` is")
        .help("a colour is [red, green, blue], linear, where 255 is 1");
    put(begin, at_, kMendedValue);
    state_ = State::After;
  }

  /// (0, 1, 5) for [0, 1, 5].
  bool read_round_list() {
    if (at_ < no_list_before_) return false;
    std::uint32_t end = at_;
    int depth = 0;
    do {
      const char c = scan_.at(end);
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (!is_word(c) && !is_one_of(c, "(), \t")) break;
      if (is_ascii_letter(c) && !is_one_of(c, "eE")) break;
      ++end;
    } while (depth > 0);
    const bool is_list =
        depth == 0 && std::count(text_.begin() + at_, text_.begin() + end, ',') > 0;
    const std::uint32_t next = scan_.skip_blanks(end);
    if (!is_list || !(scan_.ends_line(next) || is_one_of(scan_.at(next), ",;]}"))) {
      no_list_before_ = end;
      return false;
    }
    std::string list(text_.substr(at_, end - at_));
    std::ranges::replace(list, '(', '[');
    std::ranges::replace(list, ')', ']');
    const Location place = where(at_, end);
    sink_.report(diag::not_in_json, place, "round brackets are").fix(place, list);
    mended().replace(at_, list.size(), list);
    at_ = end;
    state_ = State::After;
    return true;
  }

  // Behind a value.

  void read_after() {
    const char c = text_[at_];
    if (c == '{' || c == '[' || scan_.begins_string(at_) || scan_.begins_word(at_)) {
      state_ = State::Item;  // the comma is missing
      is_first_ = false;
      return;
    }
    if (c == ';') {
      const bool is_last = is_one_of(scan_.at(scan_.skip_lines(at_ + 1)), "]}");
      const Location place = where(at_, at_ + 1);
      auto report = sink_.report(diag::expected, place, in_object() ? "`,` or `}`" : "`,` or `]`");
      // Between numbers it may separate rows.
      in_object() ? report.fix(place, is_last ? "" : ",")
                  : report.unsafe_fix(place, is_last ? "" : ",");
      put(at_, at_ + 1, is_last ? ' ' : ',');
      ++at_;
      if (!is_last) state_ = State::Item;
      is_first_ = false;
      return;
    }
    unexpected(in_object() ? "`,` or `}`" : "`,` or `]`", at_);
    std::uint32_t end = at_ + 1;
    while (!scan_.ends_line(end) && !is_one_of(text_[end], ",{}[]\"")) ++end;
    put(at_, end, ' ');
    at_ = end;
  }

  const SourceFile& file_;
  DiagnosticSink& sink_;
  std::string_view text_;
  ConfigScan scan_;
  ValueExtents extents_;
  std::optional<std::string> mended_;
  std::vector<Open> open_;
  State state_ = State::Item;
  bool is_first_ = true;  ///< nothing stands between the opening bracket and this place
  bool is_done_ = false;
  std::uint32_t at_ = 0;
  std::uint32_t name_end_ = 0;        ///< what end_of_name found last
  std::uint32_t no_list_before_ = 0;  ///< parentheses that have been tried
};

}  // namespace

std::optional<std::string> mend_syntax(const SourceFile& file, DiagnosticSink& sink) {
  return Mender(file, sink).run();
}

}  // namespace sdlc::lang
