#include "lang/repair/bracket_stack.hpp"
#include "lang/repair/brackets.hpp"
#include "lang/source/limits.hpp"

namespace sdlc::lang {
namespace {

class JsonBrackets : private BracketStack {
 public:
  explicit JsonBrackets(const TokenList& tokens) : BracketStack(tokens) {}

  std::vector<BracketFault> run() {
    if (replace_all()) return finish();
    faults_.clear();
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      if (open_.size() > 2 * kMaxNesting) return {};  // too deep to be read
      while (ends_before()) close_missing(at_);
      open_before();
      if (tokens_.is(at_, TokenClass::Open)) open(at_);
      if (tokens_.is(at_, TokenClass::Close)) read_close(tokens_[at_].bracket);
    }
    while (!open_.empty()) close_missing(at_);
    return finish();
  }

 private:
  bool in_object() const { return top().bracket == '{'; }
  bool is_item(std::uint32_t i) const {
    return i > 0 && (tokens_.is(i - 1, TokenClass::Comma) || tokens_.is(i - 1, TokenClass::Open));
  }

  /// Where every opening bracket has a closing one and only kinds differ, in pairs of one line or
  /// one indentation, the kinds are what is wrong.
  bool replace_all() {
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < tokens_.size(); ++i) {
      const RepairToken& token = tokens_[i];
      if (token.kind == TokenClass::Open) open.push_back(i);
      const bool is_label = token.kind == TokenClass::Label;
      if (is_label && !open.empty() && tokens_.is_bracket(open.back(), '[')) return false;
      if (token.kind != TokenClass::Close) continue;
      if (open.empty()) return false;
      const std::uint32_t opener = open.back();
      open.pop_back();
      const char closing = closing_bracket(tokens_[opener].bracket);
      if (token.bracket == closing) continue;
      const bool is_aligned = token.line == tokens_[opener].line ||
                              (token.is_first && token.indent == tokens_[opener].indent);
      const bool has_labels = tokens_.is(opener + 1, TokenClass::Label);
      if (!is_aligned || has_labels != (tokens_[opener].bracket == '{')) return false;
      add(BracketFault::Replaced, closing, i, opener);
    }
    return open.empty();
  }

  /// Whether the innermost bracket cannot be open any more where the token is.
  bool ends_before() const {
    const RepairToken& token = tokens_[at_];
    if (open_.size() < 2 || token.kind == TokenClass::Comma) return false;
    const bool is_open = token.kind == TokenClass::Open, is_label = token.kind == TokenClass::Label;
    if (token.kind == TokenClass::Close) return ends_before_close(token);
    if (in_object()) {
      const bool is_next =
          is_open && is_item(at_) && token.bracket == '{' && outer().bracket == '[';
      const bool is_shallow = is_label && token.is_first && token.indent <= opener().indent &&
                              outer().bracket == '{' && token.line > opener().line &&
                              opener().indent > 0;
      return is_next || is_shallow;
    }
    if (is_label) return !holds_objects() && outer().bracket == '{';
    const RepairToken& row = opener();
    return is_open && token.is_first && row.is_first && row.bracket == token.bracket &&
           row.indent == token.indent && row.line < token.line;
  }

  /// A bracket that is the first of its line, further out than the innermost open one.
  bool ends_before_close(const RepairToken& token) const {
    return token.is_first && token.line > opener().line && token.indent < opener().indent &&
           is_bracket_pair(outer().bracket, token.bracket);
  }

  /// Whether the first value of the innermost array is an object, or lacks its brace.
  bool holds_objects() const {
    return tokens_.is_bracket(top().opener + 1, '{') ||
           tokens_.is(top().opener + 1, TokenClass::Label);
  }

  void open_before() {
    const bool follows_object =
        at_ > 1 && tokens_.is(at_ - 1, TokenClass::Comma) && tokens_.is_bracket(at_ - 2, '}');
    if (tokens_.is_bracket(at_, '{') && in_object() && follows_object) return open_list();
    if (!tokens_.is(at_, TokenClass::Label) || at_ == 0) return;
    const bool is_member = tokens_.is(at_ - 1, TokenClass::Label);
    const bool is_element = top().bracket == '[' && is_item(at_);
    if (is_member || is_element) open_missing(at_, '{');
  }

  /// Of the list whose second object begins at the token: before the first, after its key.
  void open_list() {
    const auto first = static_cast<std::uint32_t>(tokens_.partner(at_ - 2));
    if (first == 0 || first > at_ || !tokens_.is(first - 1, TokenClass::Label)) return;
    open_missing(first, '[');
  }

  void read_close(char bracket) {
    if (is_bracket_pair(top().bracket, bracket)) {
      const bool ends_config = open_.size() == 1 && goes_on_after(at_);
      return ends_config ? add(BracketFault::Surplus, bracket, at_) : close(at_);
    }
    const bool closes_outer = is_bracket_pair(outer().bracket, bracket);
    const bool is_of_array = top().bracket == '[';
    const bool goes_on = tokens_.is(at_ + 1, TokenClass::Comma) &&
                         tokens_.is(at_ + 2, TokenClass::Label) != is_of_array &&
                         at_ + 2 < tokens_.size();
    const bool is_own_line = tokens_[at_].is_first && closes_outer &&
                             tokens_[at_].indent == tokens_[outer().opener].indent;
    const std::uint32_t begin = bracket == ']' && !is_of_array ? begin_of_array() : 0;
    if (is_own_line) {
      close_missing(at_);
      close(at_);
    } else if (begin != 0) {
      add(BracketFault::MissingOpen, '[', begin, at_);
    } else if (closes_outer && goes_on && !closes_on(at_ + 1, bracket)) {
      add(BracketFault::Surplus, bracket, at_);
    } else if (closes_outer) {
      close_missing(at_);
      close(at_);
    } else if (open_.size() > 1 && tokens_[at_].line == opener().line && !goes_on) {
      add(BracketFault::Replaced, closing_bracket(top().bracket), at_, top().opener);
      open_.pop_back();
    } else {
      add(BracketFault::Surplus, bracket, at_);
    }
  }

  /// Whether more of the config follows the bracket that ends it.
  bool goes_on_after(std::uint32_t i) const {
    return tokens_.is(i + 1, TokenClass::Comma) || tokens_.is(i + 1, TokenClass::Label);
  }

  /// Whether another bracket of the kind follows in the line.
  bool closes_on(std::uint32_t i, char bracket) const {
    for (; i < tokens_.size() && !tokens_[i].is_first; ++i) {
      if (tokens_.is(i, TokenClass::Open)) return false;
      if (tokens_.is_bracket(i, bracket)) return true;
    }
    return false;
  }

  /// Where the array begins whose opening bracket is missing: after the last key, if several values
  /// follow it; else 0.
  std::uint32_t begin_of_array() const {
    constexpr std::uint32_t kFar = 100;
    bool has_comma = false;
    for (std::uint32_t i = at_; i-- > 1 && i + kFar > at_;) {
      if (tokens_.is(i, TokenClass::Label)) return has_comma ? i + 1 : 0;
      if (tokens_.is(i, TokenClass::Open)) return 0;
      if (tokens_.is(i, TokenClass::Close)) {
        if (tokens_.partner(i) > i) return 0;  // it has none
        i = static_cast<std::uint32_t>(tokens_.partner(i));
      }
      has_comma = has_comma || tokens_.is(i, TokenClass::Comma);
    }
    return 0;
  }

  std::uint32_t at_ = 0;
};

}  // namespace

std::vector<BracketFault> find_json_bracket_faults(const TokenList& tokens) {
  return JsonBrackets(tokens).run();
}

}  // namespace sdlc::lang
