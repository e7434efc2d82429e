#include "lang/json/mend_syntax.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Above this a text is hardly written by hand.
constexpr std::size_t kLongestText = std::size_t{1} << 20;

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_hex(char c) { return is_digit(c) || (c >= 'a' && c <= 'f') || (c >= 'A' && c <= 'F'); }
bool is_word(char c) {
  return is_letter(c) || is_digit(c) ||
         (c != '\0' && std::string_view("_.+-$").find(c) != std::string_view::npos);
}
bool is_one_of(char c, std::string_view any) {
  return c != '\0' && any.find(c) != std::string_view::npos;
}
bool is_foreign_blank(char32_t c) {
  return c == 0x0B || c == 0x0C || c == 0xA0 || (c >= 0x2000 && c <= 0x200B) || c == 0x202F ||
         c == 0x205F || c == 0x3000 || c == 0xFEFF;
}

/// A run of things that stands in the place of one value, up to what ends a value.
struct Extent {
  std::uint32_t end = 0;  ///< behind the last of them
  std::uint32_t first_end = 0;
  int things = 0;                 ///< strings and words
  int odd = 0;                    ///< operators, parentheses and whatever else no value has
  bool is_unclosed = false;       ///< the string that comes first
  bool lacks_quote = false;       ///< the word that comes first has its closing quote alone
  std::uint32_t inner_quote = 0;  ///< behind a quote that a word follows; 0: none
};

/// Walks through a config line by line. Every byte is looked at a fixed number of times.
class Mender {
 public:
  Mender(const SourceFile& file, DiagnosticSink& sink)
      : file_(file), sink_(sink), text_(file.text()) {}

  std::optional<std::string> run() {
    constexpr std::string_view kMarks("\x1A\x1C\x1D", 3);
    const bool is_ours =
        text_.size() <= kLongestText && text_.find_first_of(kMarks) == std::string_view::npos;
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

  char at(std::size_t i) const { return i < text_.size() ? text_[i] : '\0'; }
  Location where(std::uint32_t begin, std::uint32_t end) const { return {&file_, {begin, end}}; }
  bool in_object() const { return open_.back().bracket == '{'; }
  std::uint32_t size() const { return static_cast<std::uint32_t>(text_.size()); }

  // Where things end.

  std::uint32_t skip_blanks(std::uint32_t i) const {
    while (is_one_of(at(i), " \t")) ++i;
    return i;
  }
  std::uint32_t skip_lines(std::uint32_t i) const {
    while (is_one_of(at(i), " \t\r\n")) ++i;
    return i;
  }
  bool ends_line(std::uint32_t i) const {
    return i >= text_.size() || text_[i] == '\n' || text_[i] == '\r';
  }
  std::uint32_t foreign_blank(std::uint32_t i) const {
    const char c = at(i);
    if (c != 0x0B && c != 0x0C && static_cast<unsigned char>(c) < 0x80) return 0;
    if (i >= text_.size()) return 0;
    const DecodedChar decoded = decode_utf8(text_.substr(i));
    return decoded.is_valid && is_foreign_blank(decoded.code_point) ? decoded.size : 0;
  }

  /// Past blanks and comments; false at the end, and where a comment is never closed.
  bool skip_space() {
    while (at_ < text_.size()) {
      if (is_one_of(text_[at_], " \t\r\n")) {
        ++at_;
      } else if (const std::uint32_t blank = foreign_blank(at_); blank != 0) {
        at_ += blank;
      } else if ((text_[at_] == '#' && !is_color(at_)) ||
                 (text_[at_] == '/' && at(at_ + 1) == '/')) {
        at_ = static_cast<std::uint32_t>(std::min(text_.find('\n', at_), text_.size()));
      } else if (text_[at_] == '/' && at(at_ + 1) == '*') {
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
    if (!may_be_value) return false;
    std::uint32_t end = i + 1;
    while (end < i + 10 && is_hex(at(end))) ++end;
    const std::uint32_t digits = end - i - 1;
    const bool is_size = digits == 3 || digits == 4 || digits == 6 || digits == 8;
    const std::uint32_t next = skip_blanks(end);
    return is_size && (ends_line(next) || is_one_of(at(next), ",}]"));
  }

  /// Behind the closing quote; 0 where the line ends before.
  std::uint32_t end_of_string(std::uint32_t i) const {
    const char quote = text_[i];
    for (++i; !ends_line(i); ++i) {
      if (text_[i] == '\\' && !ends_line(i + 1)) {
        ++i;
      } else if (text_[i] == quote) {
        return i + 1;
      }
    }
    return 0;
  }
  static constexpr std::uint32_t kCurlySize = 3;
  bool is_curly(std::uint32_t i) const {
    return text_.substr(i, 2) == "\xE2\x80" && (at(i + 2) == '\x9C' || at(i + 2) == '\x9D');
  }
  std::uint32_t end_of_curly(std::uint32_t i) const {
    for (i += kCurlySize; !ends_line(i); ++i) {
      if (at(i) == '\xE2' && is_curly(i)) return i + kCurlySize;
    }
    return 0;
  }
  bool begins_string(std::uint32_t i) const {
    return at(i) == '"' || at(i) == '\'' || (at(i) == '\xE2' && is_curly(i));
  }
  std::uint32_t end_of_any_string(std::uint32_t i) const {
    return at(i) == '\xE2' ? end_of_curly(i) : end_of_string(i);
  }
  std::uint32_t quote_size(std::uint32_t i) const { return at(i) == '\xE2' ? kCurlySize : 1; }
  /// Of a string that is never closed: brackets and commas at the end of its line are not its own.
  std::uint32_t end_of_unclosed(std::uint32_t begin) const {
    std::uint32_t end = begin;
    while (!ends_line(end)) ++end;
    while (end > begin + quote_size(begin) && is_one_of(text_[end - 1], " \t,]}")) --end;
    return end;
  }
  std::uint32_t end_of_word(std::uint32_t i) const {
    const bool is_number = !is_letter(at(i));
    while (is_word(at(i)) || (is_number && is_one_of(at(i), "/*") && is_digit(at(i + 1)))) {
      ++i;
    }
    return i;
  }
  bool begins_word(std::uint32_t i) const {
    return is_letter(at(i)) || is_digit(at(i)) || is_one_of(at(i), "-+.");
  }
  bool is_label_end(std::uint32_t i) const { return at(skip_blanks(i)) == ':'; }

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
    const std::string mark(text_.substr(quote, quote_size(quote)));
    sink_.report(diag::unclosed, where(quote, quote + quote_size(quote)), mark)
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
    is_done_ = !is_one_of(at(skip_lines(at_)), ",]}\"");
  }

  void close_round() {
    const Open opened = open_.back();
    const char closing = opened.bracket == '[' ? ']' : '}';
    const Location place = where(at_, at_ + 1);
    if (open_.size() == 1 || at(skip_blanks(at_ + 1)) == closing) {
      sink_.report(diag::unmatched, place, ")").unsafe_fix(place, "");
      put(at_, at_ + 1, ' ');
      ++at_;
      return;
    }
    sink_.report(diag::expected, place, fmt::format("`{}`, found `)`", closing))
        .label(where(opened.at, opened.at + 1), "opened here")
        .fix(place, std::string(1, closing));
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
    if (begins_string(at_)) {
      end = end_of_any_string(at_);
    } else if (is_letter(text_[at_])) {
      end = end_of_word(at_);
    }
    return end != 0 && is_label_end(end);
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
    if (!is_slipped || !is_label_end(end)) return false;
    sink_.report(diag::expected, where(begin, end), fmt::format("`{}`, found `{}`", key, written))
        .fix(where(begin, end), key);
    key.resize(written.size(), ' ');
    mended().replace(begin, key.size(), key);
    read_separator(begin, end);
    return true;
  }

  void read_key() {
    if (read_slipped_key()) return;
    const std::uint32_t begin = at_;
    if (begins_string(begin)) return read_quoted_key();
    const std::uint32_t colon = end_of_name(begin);
    const bool has_colon = is_one_of(at(colon), ":=");
    if (is_letter(text_[begin])) {
      std::uint32_t end = end_of_word(begin);
      if (at(end) == '"') ++end;
      const std::uint32_t next = skip_blanks(end);
      if (is_one_of(at(next), ":=") || !has_colon) return read_separator(begin, end);
      // Several words.
      std::uint32_t last = colon;
      while (is_one_of(text_[last - 1], " \t")) --last;
      const auto words = text_.substr(begin, last - begin);
      sink_.report(diag::not_in_json, where(begin, last), "a key without quotes is")
          .fix(where(begin, last), fmt::format("\"{}\"", words));
      put(begin, last, kMendedName);
      return read_separator(begin, last);
    }
    if (has_colon && colon > begin) {
      expected_key(begin);
      put(begin, colon, kMendedName);
      return read_separator(begin, colon);
    }
    if (begins_word(begin)) {  // perhaps of an array whose bracket is missing
      at_ = end_of_word(begin);
      state_ = State::After;
      return;
    }
    expected_key(begin);
    drop_member(begin, std::max(colon, begin + 1));
  }

  /// The colon behind a name of several words, or where there can be none any more.
  std::uint32_t end_of_name(std::uint32_t i) {
    if (i >= name_end_) {
      for (name_end_ = i; !ends_line(name_end_); ++name_end_) {
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
    const std::uint32_t end = end_of_any_string(begin);
    if (end != 0 && is_one_of(at(skip_lines(end)), ":=")) return read_separator(begin, end);

    std::uint32_t word_end = begin + quote_size(begin);
    while (is_word(at(word_end))) ++word_end;
    if (word_end > begin + 1 && text_[begin] == '"' && is_label_end(word_end)) {
      unclosed(begin, word_end);
      put(begin, begin + 1, kMendedName);
      return read_separator(begin, word_end);
    }
    if (text_[begin] == '\'' && at(word_end) == '"' && is_label_end(word_end + 1)) {
      const auto word = text_.substr(begin + 1, word_end - begin - 1);
      const Location place = where(begin, word_end + 1);
      sink_.report(diag::not_in_json, place, "single quotes are")
          .fix(place, fmt::format("\"{}\"", word));
      put(begin, begin + 1, '"');
      return read_separator(begin, word_end + 1);
    }
    if (end != 0) return read_separator(begin, end);
    const std::uint32_t last = end_of_unclosed(begin);
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
      if (c == '=' && is_one_of(at(at_), "=>")) put(at_, at_ + 1, ' ');
      return;
    }
    if (c == '{' || c == '[' || begins_string(found) || (begins_word(found) && found > end)) return;
    if (is_one_of(c, ",}]")) {
      // Without its brackets an array is a row of strings.
      unexpected("`:`", found);
      put(begin, end, kMendedMember);
      state_ = State::After;
      return;
    }
    std::uint32_t last = found;
    while (!ends_line(last) && !begins_word(last) && !begins_string(last) &&
           !is_one_of(text_[last], " \t,{}[]")) {
      ++last;
    }
    unexpected("`:`", found);
    if (last == found) return drop_member(begin, std::max(end_of_word(found), found + 1));
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

    const Extent extent = measure(begin);
    const std::uint32_t end = std::max(extent.end, begin + 1);
    const bool is_in_row = !in_object() || extent.things == 1;
    if (extent.odd == 0 && !extent.is_unclosed && !extent.lacks_quote && is_in_row &&
        extent.inner_quote == 0) {
      at_ = end;
      state_ = State::After;
      return;
    }
    diagnose_value(begin, extent);
    if (extent.things == 0 && is_one_of(at(skip_blanks(end)), "{[")) {
      put(begin, end, ' ');
      at_ = end;
      return;
    }
    put(begin, end, kMendedValue);
    at_ = end;
    state_ = State::After;
  }

  void diagnose_value(std::uint32_t begin, const Extent& extent) {
    if (extent.is_unclosed) return unclosed(begin, extent.end);
    if (extent.lacks_quote) {
      sink_.report(diag::expected, where(begin, extent.end), "`\"` in front of a text")
          .fix(where(begin, begin), "\"");
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
    while (is_hex(at(++at_))) {
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
      const char c = at(end);
      if (c == '(') ++depth;
      if (c == ')') --depth;
      if (!is_word(c) && !is_one_of(c, "(), \t")) break;
      if (is_letter(c) && !is_one_of(c, "eE")) break;
      ++end;
    } while (depth > 0);
    const bool is_list =
        depth == 0 && std::count(text_.begin() + at_, text_.begin() + end, ',') > 0;
    const std::uint32_t next = skip_blanks(end);
    if (!is_list || !(ends_line(next) || is_one_of(at(next), ",;]}"))) {
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

  /// Behind the parenthesis that closes the one at `i`, if the line has it; else 0.
  std::uint32_t end_of_call(std::uint32_t i) {
    if (i < no_call_before_) return 0;
    int depth = 0;
    for (; !ends_line(i) && text_[i] != '{' && text_[i] != '}'; ++i) {
      if (text_[i] == '"') {
        const std::uint32_t end = end_of_string(i);
        if (end == 0) break;
        i = end - 1;
      } else if (text_[i] == '(') {
        ++depth;
      } else if (text_[i] == ')' && --depth == 0) {
        return i + 1;
      }
    }
    no_call_before_ = i;
    return 0;
  }

  bool is_end(std::uint32_t i) const { return ends_line(i) || is_one_of(text_[i], ",}]"); }

  Extent measure(std::uint32_t begin) {
    Extent extent{.end = begin};
    std::uint32_t i = begin;
    while (true) {
      i = skip_blanks(i);
      if (ends_line(i) || is_one_of(text_[i], ",}];):{[#")) break;
      if (text_[i] == '/' && is_one_of(at(i + 1), "/*")) break;
      if (const std::uint32_t blank = foreign_blank(i); blank != 0) {
        i += blank;
        continue;
      }
      if (begins_string(i)) {
        const std::uint32_t end = end_of_any_string(i);
        if (end != 0 && extent.things + extent.odd > 0 && is_label_end(end)) break;
        if (end == 0) {
          extent.is_unclosed = extent.things + extent.odd == 0;
          extent.odd += extent.is_unclosed ? 0 : 1;
          extent.end = end_of_unclosed(i);
          break;
        }
        if (is_letter(at(end)) || is_digit(at(end))) {
          const std::uint32_t last = value_before_key(i, end);
          if (last != 0) {
            extent.is_unclosed = extent.things + extent.odd == 0;
            extent.odd += extent.is_unclosed ? 0 : 1;
            extent.end = last;
            break;
          }
          if (extent.inner_quote == 0) extent.inner_quote = end;
        }
        ++extent.things;
        i = end;
      } else if (begins_word(i)) {
        const std::uint32_t end = end_of_word(i);
        if (extent.things + extent.odd > 0 && is_label_end(end)) break;
        const bool is_alone = i == begin && is_end(skip_blanks(end));
        const bool is_operator =
            end == i + 1 && !is_letter(text_[i]) && !is_digit(text_[i]) && !is_alone;
        ++(is_operator ? extent.odd : extent.things);
        i = end;
        if (at(i) == '"' && extent.things == 1 && extent.odd == 0 && is_letter(text_[begin])) {
          extent.lacks_quote = true;
          extent.end = i + 1;
          break;
        }
      } else {
        ++extent.odd;
        const std::uint32_t call = text_[i] == '(' ? end_of_call(i) : 0;
        if (call != 0) {
          i = call;
          ++extent.things;
        } else {
          i += decode_utf8(text_.substr(i)).size;
        }
      }
      extent.end = i;
      if (extent.first_end == 0) extent.first_end = i;
    }
    return extent;
  }

  /// "a.png, "next": the string from `begin` to `end` ends at the quote of a key, whose own text
  /// follows. Returns the end of the value; 0 where it is not so.
  std::uint32_t value_before_key(std::uint32_t begin, std::uint32_t end) const {
    std::uint32_t word = end;
    while (is_word(at(word))) ++word;
    if (at(word) != '"' || !is_label_end(word + 1)) return 0;
    std::uint32_t last = end - 1;
    while (last > begin && is_one_of(text_[last - 1], " \t")) --last;
    if (last <= begin + 1 || text_[last - 1] != ',') return 0;
    return last - 1;
  }

  // Behind a value.

  void read_after() {
    const char c = text_[at_];
    if (c == '{' || c == '[' || begins_string(at_) || begins_word(at_)) {
      state_ = State::Item;  // the comma is missing
      is_first_ = false;
      return;
    }
    if (c == ';') {
      const bool is_last = is_one_of(at(skip_lines(at_ + 1)), "]}");
      const Location place = where(at_, at_ + 1);
      sink_.report(diag::expected, place, in_object() ? "`,` or `}`" : "`,` or `]`")
          .fix(place, is_last ? "" : ",");
      put(at_, at_ + 1, is_last ? ' ' : ',');
      ++at_;
      if (!is_last) state_ = State::Item;
      is_first_ = false;
      return;
    }
    unexpected(in_object() ? "`,` or `}`" : "`,` or `]`", at_);
    std::uint32_t end = at_ + 1;
    while (!ends_line(end) && !is_one_of(text_[end], ",{}[]\"")) ++end;
    put(at_, end, ' ');
    at_ = end;
  }

  const SourceFile& file_;
  DiagnosticSink& sink_;
  std::string_view text_;
  std::optional<std::string> mended_;
  std::vector<Open> open_;
  State state_ = State::Item;
  bool is_first_ = true;  ///< nothing stands between the opening bracket and this place
  bool is_done_ = false;
  std::uint32_t at_ = 0;
  std::uint32_t name_end_ = 0;                             ///< what end_of_name found last
  std::uint32_t no_list_before_ = 0, no_call_before_ = 0;  ///< parentheses that have been tried
};

}  // namespace

std::string describe_character(char32_t c) {
  std::string text = fmt::format("U+{:04X}", static_cast<std::uint32_t>(c));
  if (c < 0x20 || c == 0x7F) return text;
  std::string shown;
  append_utf8(c, shown);
  return is_unsafe_on_terminal(c) || display_width(c) == 0 ? text
                                                           : fmt::format("`{}` ({})", shown, text);
}

std::optional<std::string> mend_syntax(const SourceFile& file, DiagnosticSink& sink) {
  return Mender(file, sink).run();
}

}  // namespace sdlc::lang
