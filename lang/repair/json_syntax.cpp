#include "lang/repair/json_syntax.hpp"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "lang/repair/repair_report.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Walks through a config item by item.
class JsonSyntax : private RepairRound {
 public:
  using RepairRound::RepairRound;

  std::vector<Edit> run() {
    if (!tokens_.is_bracket(0, '{')) return {};
    open();
    while (i_ < tokens_.size() && !open_.empty()) {
      stop_if_requested();
      step();
    }
    return std::move(edits_);
  }

 private:
  enum class State : std::uint8_t { Item, Value, After };

  bool in_object() const { return tokens_.is_bracket(open_.back(), '{'); }
  std::string_view separator() const { return in_object() ? "`,` or `}`" : "`,` or `]`"; }
  bool is_operator(std::size_t i) const { return tokens_.is(i, TokenClass::Operator); }
  bool is_value(std::size_t i) const { return tokens_.is(i, TokenClass::Value); }
  char first(std::size_t i) const {
    return i < tokens_.size() ? tokens_.text()[tokens_[i].begin] : '\0';
  }
  bool is_quoted(std::size_t i) const {
    return first(i) == '"' || first(i) == '\'' || first(i) == '\xE2';
  }
  /// Bytes of the quote that begins the token.
  std::uint32_t quote_size(std::size_t i) const { return first(i) == '\xE2' ? 3 : 1; }
  /// Whether the string, perhaps of a label, lacks its closing quote.
  bool is_unclosed(std::size_t i) const {
    if (!is_quoted(i)) return false;
    const std::string_view text = name(i);
    const std::uint32_t quote = quote_size(i);
    return text.size() < 2 * quote ||
           (quote == 3 ? !text.ends_with("\u201D") && !text.ends_with("\u201C")
                       : text.back() != text[0]);
  }
  /// The token without the colon after it.
  std::string_view name(std::size_t i) const {
    std::string_view text = tokens_.written(i);
    if (!tokens_.is(i, TokenClass::Label)) return text;
    text.remove_suffix(1);
    return text.substr(0, text.find_last_not_of(" \t") + 1);
  }
  Span name_span(std::size_t i) const {
    return {tokens_[i].begin, tokens_[i].begin + static_cast<std::uint32_t>(name(i).size())};
  }
  void put(Span span, char mark) { edit(span, std::string(1, mark)); }
  void go_on(std::size_t i, State state) {
    i_ = i;
    state_ = state;
    is_first_ = false;
  }

  void unexpected(std::string_view expected, std::uint32_t at) {
    const DecodedChar c = decode_utf8(tokens_.text().substr(at));
    if (!c.is_valid) {
      report(diag::bad_utf8, {at, at + 1});
    } else if (c.code_point < 0x20 || c.code_point > 0x7E) {
      report(diag::bad_character, {at, at + c.size}, describe_character(c.code_point));
    } else {
      report(diag::expected, {at, at + 1}, expected);
    }
  }
  void unclosed(std::size_t i) {
    const Span quote{tokens_[i].begin, tokens_[i].begin + quote_size(i)};
    const std::uint32_t end = name_span(i).end;
    report(diag::unclosed, quote, text_of(quote))
        .unsafe_fix(where({end, end}), quote.size() == 1 ? std::string(text_of(quote)) : "\u201D");
  }

  void step() {
    const RepairToken& token = tokens_[i_];
    if (token.bracket == ')') return close_round();
    if (token.kind == TokenClass::Close) return close();
    if (token.kind == TokenClass::Comma) return go_on(i_ + 1, State::Item);
    const bool is_label = token.kind == TokenClass::Label;
    switch (state_) {
      case State::After: return read_after();
      case State::Value: return read_value();
      case State::Item:
        if (token.bracket == '{' || token.bracket == '[') return open();
        if (!in_object() && is_label) {
          while (open_.size() > 1 && !in_object()) open_.pop_back();
        }
        return in_object() ? read_key() : read_value();
    }
  }

  void open() {
    open_.push_back(i_);
    go_on(i_ + 1, State::Item);
    is_first_ = true;
  }

  void close() {
    const char opening = tokens_[i_].bracket == ']' ? '[' : '{';
    const std::size_t depth = open_.size();
    const auto fits = [&](std::size_t n) {
      return depth > n && tokens_.is_bracket(open_[depth - 1 - n], opening);
    };
    const std::size_t count = fits(0) ? 1 : fits(1) ? 2 : 0;
    go_on(i_ + 1, State::After);
    if (count < depth) return open_.resize(depth - count);
    // The config goes on where its closing bracket is one too many.
    const bool goes_on =
        tokens_.is(i_, TokenClass::Comma) || tokens_.is(i_, TokenClass::Close) || first(i_) == '"';
    open_.resize(goes_on ? 1 : 0);
  }

  void close_round() {
    const std::size_t opener = open_.back();
    const char closing = in_object() ? '}' : ']';
    const Span place = span_of(i_);
    if (open_.size() == 1 || tokens_.is_bracket(i_ + 1, closing)) {
      auto message = report(diag::unmatched, place, ")");
      message.unsafe_fix(where(place), "");
      edit(place, " ");
      ++i_;
      return;
    }
    auto message = report(diag::expected, place, fmt::format("`{}`, found `)`", closing));
    message.label(where(span_of(opener)), "opened here");
    fix(message, false, place, std::string(1, closing));
    open_.pop_back();
    go_on(i_ + 1, State::After);
  }

  // Keys

  void read_key() {
    if (tokens_.is(i_, TokenClass::Label)) return read_label();
    const bool is_letter = is_ascii_letter(first(i_));
    std::size_t label = i_;
    while (is_letter && is_value(label) && tokens_.is_same_line(label + 1) && !is_quoted(label))
      ++label;
    if (label > i_ && tokens_.is(label, TokenClass::Label) && !is_quoted(label)) {
      const Span words{tokens_[i_].begin, name_span(label).end};
      auto message = report(diag::not_in_json, words, "a key without quotes is");
      message.unsafe_fix(where(words), fmt::format("\"{}\"", text_of(words)));
      put(words, kRepairedName);
      return go_on(label + 1, State::Value);
    }
    if (is_quoted(i_) && is_unclosed(i_)) {
      unclosed(i_);
      const std::size_t next = i_ + 1;  // perhaps the rest of a key with a line end in it
      if (!tokens_.is(next, TokenClass::Label) || name(next) != "\"") return drop_member(i_);
      unclosed(next);
      put({tokens_[i_].begin, name_span(next).end}, kRepairedName);
      return go_on(next + 1, State::Value);
    }
    if (is_quoted(i_) || (is_value(i_) && is_letter)) return read_separator();
    const bool has_colon = tokens_.is(i_ + 1, ":");
    // Perhaps a number of an array whose bracket is missing.
    if (is_value(i_) && !has_colon) return go_on(i_ + 1, State::After);
    unexpected(is_first_ ? "a key in double quotes or `}`" : "a key in double quotes",
               tokens_[i_].begin);
    if (!has_colon) return drop_member(i_);
    put(span_of(i_), kRepairedName);
    go_on(i_ + 2, State::Value);
  }

  void read_label() {
    std::string plain(name(i_));
    std::erase(plain, '"');
    const std::string key = fmt::format("\"{}\"", plain);
    const bool is_slipped = name(i_) != key && std::ranges::count(name(i_), '"') >= 2;
    if (is_slipped) {
      auto message =
          report(diag::expected, name_span(i_), fmt::format("`{}`, found `{}`", key, name(i_)));
      message.unsafe_fix(where(name_span(i_)), key);
      put(name_span(i_), kRepairedName);
    } else if (is_unclosed(i_)) {
      const std::uint32_t begin = tokens_[i_].begin;
      unclosed(i_);
      put({begin, begin + 1}, kRepairedName);
    }
    const std::uint32_t sign = tokens_[i_].end;
    const bool is_doubled = tokens_.is_joined(i_ + 1) && is_operator(i_ + 1) &&
                            tokens_.text()[sign - 1] == '=' &&
                            (tokens_.is(i_ + 1, "=") || tokens_.is(i_ + 1, ">"));
    if (is_doubled) edit(span_of(i_ + 1), " ");
    go_on(i_ + 1 + is_doubled, State::Value);
  }

  void drop_member(std::size_t last) {
    put(span_of(i_, last), kRepairedMember);
    go_on(last + 1, State::After);
  }

  /// A key without a colon in its line.
  void read_separator() {
    const std::size_t next = i_ + 1;
    if (tokens_.is(next, ":") || tokens_.is(next, "=")) return go_on(next + 1, State::Value);
    if (is_value(next) || tokens_.is_bracket(next, '{') || tokens_.is_bracket(next, '[')) {
      return go_on(next, State::Value);  // the colon is missing
    }
    if (next >= tokens_.size()) return go_on(next, State::After);
    unexpected("`:`", tokens_[next].begin);
    if (!is_operator(next)) return drop_member(i_);
    std::size_t last = next;
    while (is_operator(last + 1) && tokens_.is_joined(last + 1)) ++last;
    edit(span_of(next, last), ":");
    go_on(last + 1, State::Value);
  }

  // Values

  void read_value() {
    const char c = first(i_);
    if (c == '{' || c == '[') return open();
    if (c == '#') return color();
    if (c == '(' && round_list()) return;
    if (tokens_.is(i_, TokenClass::Label)) {
      // The brace is missing, which the repair of brackets reports.
      open_.push_back(open_.front());
      return go_on(i_, State::Item);
    }
    if (c == ':' || c == '=' || c == ';') {
      unexpected("a value", tokens_[i_].begin);
      put(span_of(i_), c == ';' ? kRepairedValue : ' ');
      return go_on(i_ + 1, c == ';' ? State::After : State::Value);
    }
    read_run();
  }

  /// The tokens in place of one value: those of a line up to a mark, a bracket or the next key.
  void read_run() {
    std::size_t end = i_, values = 0, odd = 0, inner_quote = 0;
    bool is_broken = false;
    for (; !is_broken && (end == i_ || tokens_.is_same_line(end)) && !ends_run(end); ++end) {
      is_broken = is_unclosed(end) || lacks_quote(end);
      const bool is_one = is_value(end) && (!is_unclosed(end) || end == i_);
      ++(is_one ? values : odd);
      if (is_one && is_quoted(end) && tokens_.is_joined(end + 1) && is_value(end + 1)) {
        inner_quote = inner_quote == 0 ? end + 1 : inner_quote;
      }
      const std::size_t close = tokens_.is_bracket(end, '(') ? tokens_.partner(end) : end;
      if (close != end && tokens_[close].line == tokens_[end].line) {
        ++values;
        end = close;
      }
    }
    end = std::max(end, i_ + 1);
    const bool is_fine =
        odd == 0 && !is_broken && inner_quote == 0 && (!in_object() || values == 1);
    if (is_fine) return go_on(end, State::After);
    if (values == 0) {
      unexpected("a value", tokens_[i_].begin);
      const bool is_open = tokens_.is_bracket(end, '{') || tokens_.is_bracket(end, '[');
      put(span_of(i_, end - 1), is_open ? ' ' : kRepairedValue);
      return go_on(end, is_open ? state_ : State::After);
    }
    diagnose_run(end, odd, inner_quote);
    put(span_of(i_, end - 1), kRepairedValue);
    go_on(end, State::After);
  }

  void diagnose_run(std::size_t end, std::size_t odd, std::size_t inner_quote) {
    const Span begin{tokens_[i_].begin, tokens_[i_].begin};
    if (is_unclosed(i_)) return unclosed(i_);
    if (lacks_quote(i_)) {
      auto message = report(diag::expected, span_of(i_), "`\"` before a text");
      message.unsafe_fix(where(begin), "\"");
    } else if (inner_quote != 0) {
      report(diag::expected, gap_before(inner_quote), "`,`")
          .help("a quote inside a string is written `\\\"`");
    } else if (odd == 0) {
      report(diag::expected, gap_before(i_ + 1), separator());
    } else {
      report(diag::not_in_json, span_of(i_, end - 1), "calculations are").help("write the result");
    }
  }

  bool ends_run(std::size_t i) const {
    const TokenClass kind = tokens_[i].kind;
    if (kind == TokenClass::Open) return !tokens_.is_bracket(i, '(');
    return kind == TokenClass::Comma || kind == TokenClass::Close || kind == TokenClass::End ||
           kind == TokenClass::Label || first(i) == ';' || first(i) == ':' || first(i) == '#';
  }
  /// `value",`
  bool lacks_quote(std::size_t i) const {
    return is_value(i) && is_ascii_letter(first(i)) && tokens_.written(i).ends_with('"');
  }

  void color() {
    report(diag::not_in_json, span_of(i_), "a colour with `#` is")
        .help("a colour is [red, green, blue], linear, where 255 is 1");
    put(span_of(i_), kRepairedValue);
    go_on(i_ + 1, State::After);
  }

  /// (0, 1, 5) for [0, 1, 5]
  bool round_list() {
    const std::size_t close = tokens_.partner(i_);
    if (!tokens_.is_bracket(close, ')')) return false;
    bool has_comma = false;
    for (std::size_t i = i_ + 1; i < close; ++i) {
      const bool is_number =
          is_value(i) && (is_ascii_digit(first(i)) || first(i) == '-' || first(i) == '.');
      const bool is_part = tokens_.is_bracket(i, '(') || tokens_.is_bracket(i, ')');
      has_comma = has_comma || tokens_.is(i, TokenClass::Comma);
      if (!is_number && !is_part && !tokens_.is(i, TokenClass::Comma)) return false;
    }
    const bool is_end = tokens_[close + 1].is_first || tokens_.is(close + 1, TokenClass::Comma) ||
                        tokens_.is(close + 1, TokenClass::Close) || first(close + 1) == ';';
    if (!has_comma || !is_end) return false;
    std::string list(text_of(span_of(i_, close)));
    std::ranges::replace(list, '(', '[');
    std::ranges::replace(list, ')', ']');
    auto message = report(diag::not_in_json, span_of(i_, close), "round brackets are");
    fix(message, true, span_of(i_, close), list);
    go_on(close + 1, State::After);
    return true;
  }

  // After a value

  void read_after() {
    if (tokens_.is(i_, TokenClass::Open) || is_value(i_) || tokens_.is(i_, TokenClass::Label)) {
      return go_on(i_, State::Item);  // the comma is missing
    }
    if (tokens_.is(i_, ";")) return semicolon();
    unexpected(separator(), tokens_[i_].begin);
    std::size_t end = i_ + 1;
    while (tokens_.is_same_line(end) && (is_operator(end) || is_value(end)) && !is_quoted(end))
      ++end;
    edit(span_of(i_, end - 1), " ");
    i_ = end;
  }

  /// It separates members if a key follows; between values it may be another sign.
  void semicolon() {
    const bool is_last = tokens_.is(i_ + 1, TokenClass::Close);
    auto message = report(diag::expected, span_of(i_), separator());
    const bool is_safe = in_object() && (is_last || tokens_.is(i_ + 1, TokenClass::Label));
    add_fix(message, is_safe, where(span_of(i_)), is_last ? "" : ",");
    edit(span_of(i_), is_last ? " " : ",");
    go_on(i_ + 1, is_last ? State::After : State::Item);
  }

  std::vector<std::size_t> open_;  ///< the opening brackets around the token
  State state_ = State::Item;
  bool is_first_ = true;  ///< nothing is between the opening bracket and the token
  std::size_t i_ = 0;
};

}  // namespace

std::vector<Edit> repair_json_syntax(const RepairContext& context, const TokenList& tokens) {
  return JsonSyntax(context, tokens).run();
}

}  // namespace sdlc::lang
