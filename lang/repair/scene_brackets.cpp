#include "lang/repair/bracket_stack.hpp"
#include "lang/repair/brackets.hpp"
#include "lang/repair/property_names.hpp"
#include "lang/repair/vocabulary.hpp"

namespace sdlc::lang {
namespace {

/// Goes through the statements of the file one by one: a fault in one has no effect on the next.
class SceneBrackets : private BracketStack {
 public:
  explicit SceneBrackets(const TokenList& tokens) : BracketStack(tokens) {}

  std::vector<BracketFault> run() {
    for (std::uint32_t begin = 0; begin < size();) {
      end_ = end_of_statement(begin);
      if (!matches(begin) && !replace_all(begin)) scan(begin);
      begin = end_;
    }
    return finish();
  }

 private:
  static constexpr std::uint32_t kNone = BracketFault::kNone;

  std::uint32_t size() const { return static_cast<std::uint32_t>(tokens_.size()); }
  static bool is_brace(char bracket) { return bracket == '{' || bracket == '}'; }

  // The statements of the file

  /// Whether what the brace at the token encloses is not indented.
  bool is_flush(std::uint32_t brace) const {
    const RepairToken& inside = tokens_[brace + 1];
    return inside.is_first && inside.kind != TokenClass::Close &&
           inside.indent <= tokens_[brace].indent &&
           !(holds_properties(brace) && tokens_.begins_statement(brace + 1));
  }

  /// The kind of the object whose head, a kind and perhaps a name, ends before the token; kNone if
  /// none does.
  std::uint32_t kind_before(std::uint32_t i) const {
    if (i == 0 || !tokens_.is_name(i - 1)) return kNone;
    if (tokens_.may_begin_statement(i - 1)) return i - 1;
    const bool has_name = i > 1 && tokens_.is_name(i - 2) && tokens_.is_same_line(i - 1) &&
                          tokens_.may_begin_statement(i - 2);
    return has_name ? i - 2 : kNone;
  }

  /// Whether the brace opens an object that can only contain properties.
  bool holds_properties(std::uint32_t brace) const {
    const std::uint32_t kind = kind_before(brace);
    return kind != kNone && !tokens_.is(kind, "group");
  }

  std::uint32_t end_of_statement(std::uint32_t begin) const {
    std::size_t flush = 0;
    for (std::uint32_t i = begin; i < size(); ++i) {
      const RepairToken& token = tokens_[i];
      const bool is_next = i > begin && token.is_first && token.indent == 0 && flush == 0 &&
                           tokens_.begins_statement(i);
      if (is_next) return i;
      if (token.bracket == '{' && (flush > 0 || is_flush(i))) ++flush;
      if (token.bracket == '}' && flush > 0) --flush;
    }
    return size();
  }

  bool matches(std::uint32_t begin) const {
    std::uint32_t depth = 0;
    for (std::uint32_t i = begin; i < end_; ++i) {
      if (tokens_.is(i, TokenClass::Open)) {
        ++depth;
        const std::size_t close = tokens_.partner(i);
        if (close >= end_ || !is_bracket_pair(tokens_[i].bracket, tokens_[close].bracket)) {
          return false;
        }
      } else if (tokens_.is(i, TokenClass::Close) && depth-- == 0) {
        return false;
      }
    }
    return depth == 0;
  }

  /// Where every opening bracket has a closing one and only kinds differ, in pairs of one line, the
  /// kinds are what is wrong.
  bool replace_all(std::uint32_t begin) {
    std::vector<std::uint32_t> open;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> wrong;
    for (std::uint32_t i = begin; i < end_; ++i) {
      if (tokens_.is(i, TokenClass::Open)) open.push_back(i);
      if (!tokens_.is(i, TokenClass::Close)) continue;
      if (open.empty()) return false;
      const std::uint32_t opener = open.back();
      open.pop_back();
      const bool is_pair = is_bracket_pair(tokens_[opener].bracket, tokens_[i].bracket);
      const bool is_one_line = tokens_[opener].line == tokens_[i].line;
      if (is_pair && !is_one_line && !tokens_[opener + 1].is_first) return false;
      if (is_pair) continue;
      if (tokens_[opener].line != tokens_[i].line) return false;
      wrong.emplace_back(opener, i);
    }
    if (!open.empty() || wrong.empty()) return false;
    const bool is_swap = wrong.size() == 2 && wrong[0].second + 1 == wrong[1].second;
    if (is_swap) {
      add(BracketFault::Swapped, tokens_[wrong[1].second].bracket, wrong[0].second);
      return true;
    }
    for (const auto& [opener, closer] : wrong) {
      const bool is_value =
          tokens_[opener].bracket == '{' && opener > 0 &&
          (tokens_.wants_operand(opener - 1) || !is_brace(tokens_[closer].bracket));
      if (is_value && opener > begin && tokens_.wants_operand(opener - 1)) {
        add(BracketFault::Replaced, tokens_[closer].bracket == ')' ? '(' : '[', opener, closer);
      } else {
        add(BracketFault::Replaced, closing_bracket(tokens_[opener].bracket), closer, opener);
      }
    }
    return true;
  }

  // One statement

  void scan(std::uint32_t begin) {
    header_ = kNone;
    for (at_ = begin; at_ < end_; ++at_) {
      const RepairToken& token = tokens_[at_];
      close_before();
      open_before();
      note_header();
      if (token.kind == TokenClass::Open) read_open();
      if (token.kind == TokenClass::Close) read_close();
    }
    while (!open_.empty()) close_missing(end_);
  }

  /// Whether the token goes on with what the line before has begun.
  bool continues(std::uint32_t i) const {
    const RepairToken& token = tokens_[i];
    if (token.kind == TokenClass::Operator || token.kind == TokenClass::Comma) return true;
    if (token.kind == TokenClass::Open || (i > 0 && tokens_.wants_operand(i - 1))) return true;
    return tokens_.is_word(i) && is_one_of(tokens_.written(i), kLinkWords);
  }

  /// Closes what cannot be open any more where the token is.
  void close_before() {
    while (is_in_parenthesis() && ends_parenthesis()) close_missing(at_);
    while (top().bracket == '{' && ends_block()) close_missing(at_);
    while (is_in_parenthesis() && ends_parenthesis()) close_missing(at_);
  }

  bool ends_parenthesis() const {
    const RepairToken& token = tokens_[at_];
    if (tokens_.begins_statement(at_)) return true;
    if (token.bracket == '{') return !tokens_.wants_operand(at_ - 1);
    if (token.bracket == '}') return true;
    if (token.kind == TokenClass::Label) return ends_before_label();
    // A row of a table, and the row before it is still open.
    const RepairToken& row = opener();
    return token.kind == TokenClass::Open && token.is_first && row.is_first &&
           top().bracket == token.bracket && row.indent == token.indent && row.line < token.line;
  }

  /// Whether the label is that of a property, not of an argument.
  bool ends_before_label() const {
    const std::uint32_t opened = top().opener;
    if (top().bracket != '(' || top().fault != kNoFault) return top().bracket == '[';
    if (tokens_.holds_parameters(opened)) return false;
    if (is_closed_in_line(opened)) return false;
    if (!tokens_.holds_arguments(opened)) return true;
    const bool is_next = tokens_.is(at_ - 1, TokenClass::Comma) || at_ == opened + 1;
    if (!is_next && tokens_[at_].is_first) return true;
    const std::string_view name = tokens_.label(at_), callee = tokens_.written(opened - 1);
    const bool has_labels = tokens_.is(opened + 1, TokenClass::Label);
    return is_object_property(name) && !is_argument_of(callee, name) &&
           (is_material(callee) || !has_labels);
  }

  /// Whether the bracket has one of its kind in its line, with matching ones between.
  bool is_closed_in_line(std::uint32_t open) const {
    const std::size_t close = tokens_.partner(open);
    return is_bracket_pair(tokens_[open].bracket, tokens_[close].bracket) &&
           tokens_[open].line == tokens_[close].line;
  }

  /// Whether the line at the token is outside of the block.
  bool ends_block() const {
    const RepairToken& token = tokens_[at_];
    const RepairToken& brace = opener();
    if (!token.is_first || token.line == brace.line || is_flush(top().opener)) return false;
    if (token.kind == TokenClass::Close) {
      return token.bracket == '}' && token.indent < brace.indent && outer().bracket == '{';
    }
    return token.indent <= brace.indent && !continues(at_);
  }

  // Headers of blocks, which lack their brace

  void note_header() {
    const RepairToken& token = tokens_[at_];
    if (token.bracket == '{') header_ = kNone;
    if (is_in_parenthesis() || !tokens_.is_word(at_)) return;
    const std::string_view word = tokens_.written(at_);
    const bool begins = tokens_.begins_statement(at_);
    if (begins || (word == "else" && at_ > 0 && tokens_.is_bracket(at_ - 1, '}'))) {
      const bool has_block = word == "for" || word == "if" || word == "def" || word == "else";
      header_ = has_block ? at_ : kNone;
    }
  }

  void open_before() {
    if (at_ == 0 || tokens_[at_].kind == TokenClass::Open) return;
    const bool is_new_line = tokens_[at_].is_first && !continues(at_) &&
                             !tokens_.is(at_ - 1, TokenClass::Comma) &&
                             tokens_[at_].kind != TokenClass::Close;
    const bool has_header = header_ != kNone && header_ != at_ && is_new_line &&
                            tokens_[at_].indent > tokens_[header_].indent;
    const bool may_be_inside = is_new_line || tokens_.is(at_, TokenClass::Label);
    if (has_header || (may_be_inside && kind_before(at_) != kNone)) {
      if (!is_in_parenthesis()) open_missing(at_, '{');
      header_ = kNone;
    } else if (lacks_parenthesis()) {
      open_missing(at_, '(');
    }
  }

  /// `diffuse color: red)`, `max 1, 2)` and `fn f x) =`
  bool lacks_parenthesis() const {
    const auto is_head = [&](std::uint32_t i) {
      return tokens_.is(i, "fn") || tokens_.is(i, "def");
    };
    const bool is_label = tokens_.is(at_, TokenClass::Label);
    if (at_ > 1 && is_head(at_ - 2) && tokens_.is_name(at_ - 1)) return true;
    // The name of the function has run together with the first label.
    if (is_label && tokens_.is(at_ - 1, TokenClass::Label) && tokens_.is_same_line(at_))
      return true;
    if (at_ < 2 || !tokens_.is_name(at_ - 1) || !tokens_.wants_operand(at_ - 2)) return false;
    const bool is_same_line = tokens_.is_same_line(at_);
    return is_same_line && (is_label || tokens_.is_number(at_));
  }

  // Brackets

  void read_open() {
    const bool is_stray =
        tokens_[at_].bracket == '{' && at_ > 0 && tokens_.is_bracket(at_ - 1, '{');
    if (is_stray) return add(BracketFault::Surplus, '{', at_);
    open(at_);
  }

  void read_close() {
    const char bracket = tokens_[at_].bracket;
    const bool is_pair = is_bracket_pair(top().bracket, bracket);
    if (is_pair) {
      if (bracket == '}' && is_surplus_brace()) return add(BracketFault::Surplus, '}', at_);
      return close(at_);
    }
    if (top().bracket == '(' && top().fault != kNoFault && bracket == ']') {
      faults_[top().fault].bracket = '[';
      return close(at_);
    }
    const RepairToken& token = tokens_[at_];
    const bool ends_block = top().bracket == '{' && token.is_first && ends_line(top()) &&
                            token.indent == opener().indent && token.line > opener().line;
    if (ends_block) return replace();
    if (!is_in_parenthesis() || bracket == '}') return read_unmatched(bracket);

    const char next = tokens_.is(at_ + 1, TokenClass::Close) ? tokens_[at_ + 1].bracket : '\0';
    const bool closes_outer = is_bracket_pair(outer().bracket, bracket);
    if (!closes_outer && is_bracket_pair(top().bracket, next)) {
      add(BracketFault::Surplus, bracket, at_);
    } else if (closes_outer && is_bracket_pair(top().bracket, next)) {
      add(BracketFault::Swapped, next, at_);
      open_.pop_back();
      open_.pop_back();
      ++at_;
    } else if (closes_outer && !is_bracket_pair(outer().bracket, next)) {
      close_missing(at_);
      close(at_);
    } else {
      replace();
    }
  }

  void replace() {
    add(BracketFault::Replaced, closing_bracket(top().bracket), at_, top().opener);
    open_.pop_back();
  }

  /// Whether a brace that closes a block of several lines does so too soon.
  bool is_surplus_brace() const {
    const RepairToken &token = tokens_[at_], &next = tokens_[at_ + 1];
    if (!ends_line(top()) || token.line == opener().line || at_ + 1 >= end_) return false;
    const bool is_deeper = token.is_first && token.indent > opener().indent;
    const bool ends_next = next.bracket == '}' && next.is_first && next.indent == opener().indent;
    if (is_deeper && ends_next) return true;
    const bool goes_on = next.is_first && next.indent > opener().indent;
    return goes_on && (!token.is_first || token.indent > opener().indent);
  }

  /// A closing bracket without an open one of its kind in its value.
  void read_unmatched(char bracket) {
    const std::uint32_t begin = bracket == '}' ? kNone : begin_of_missing_pair();
    if (begin == kNone) return add(BracketFault::Surplus, bracket, at_);
    add(BracketFault::MissingOpen, bracket == ')' ? '(' : '[', begin, at_);
  }

  /// Where the bracket that the token closes must have been: before the first of several values
  /// after a label or `=`.
  std::uint32_t begin_of_missing_pair() const {
    constexpr std::uint32_t kFar = 100;
    int depth = 0;
    bool has_comma = false;
    for (std::uint32_t i = at_; i-- > 0 && i + kFar > at_;) {
      if (tokens_.is(i, TokenClass::Close)) ++depth;
      if (tokens_.is(i, TokenClass::Open) && depth-- == 0) return kNone;
      if (depth > 0) continue;
      has_comma = has_comma || tokens_.is(i, TokenClass::Comma);
      const bool begins =
          tokens_.is(i, TokenClass::Label) || tokens_.is(i, "=") || tokens_.is(i, "in");
      if (begins) return has_comma && i + 1 < at_ ? i + 1 : kNone;
      if (tokens_.begins_statement(i)) return kNone;
    }
    return kNone;
  }

  std::uint32_t end_ = 0, at_ = 0;
  std::uint32_t header_ = kNone;  ///< the first token of a `for`, `if` or `def` without its block
};

}  // namespace

std::vector<BracketFault> find_scene_bracket_faults(const TokenList& tokens) {
  return SceneBrackets(tokens).run();
}

}  // namespace sdlc::lang
