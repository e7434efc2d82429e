#include <algorithm>
#include <array>
#include <string>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/repair/scene_round.hpp"
#include "lang/repair/vocabulary.hpp"

namespace sdlc::lang {
namespace {

/// Heads of blocks, loops and functions of other languages. Tries each rule at each token: one that
/// applies reports, makes its edits and returns true.
class Blocks : private SceneRound {
 public:
  using SceneRound::SceneRound;

  std::vector<Edit> run() {
    i_ = surrounding_block();
    walk([this] {
      if (tokens_[i_].is_first) line_ = i_;
      if (indented_block() || then_block() || !tokens_.may_begin_statement(i_)) return;
      static_cast<void>(loop() || while_loop() || function_block() || function_by_let());
    });
    edits_.insert(edits_.end(), block_ends_.rbegin(), block_ends_.rend());
    return std::move(edits_);
  }

 private:
  bool is_last_of_line(std::size_t i) const { return tokens_[i + 1].is_first; }
  /// The brace in the line of the token that opens a block after it; size() if there is none.
  std::size_t brace_of_line(std::size_t i) const {
    constexpr int kMaxTokens = 100;
    for (int n = 0; n < kMaxTokens && i < tokens_.size(); ++n) {
      if (tokens_.is_bracket(i, '{')) return i;
      if (tokens_.is(i, TokenClass::Open)) i = std::max(i, tokens_.partner(i));
      if (tokens_[++i].is_first) break;
    }
    return tokens_.size();
  }

  // Blocks

  /// `scene "name" { … }` around the whole file. Returns the first token after it.
  std::size_t surrounding_block() {
    if (!tokens_.is(0, "scene")) return 0;
    const std::size_t open = tokens_.is_string(1) || tokens_.is_name(1) ? 2 : 1;
    if (!tokens_.is_bracket(open, '{') || tokens_[open].line != tokens_[0].line) return 0;
    auto message = report(diag::missing_version, span_of(0, open));
    message.help("the first statement is `scene 1`; no block surrounds the others");
    fix(message, false, span_of(0, open), "scene 1");
    const std::size_t last = tokens_.size() - 1;
    if (tokens_.is_bracket(last, '}')) fix(message, false, span_of(last), "");
    return open + 1;
  }

  /// `for i in list:` with the block's lines indented, as in Python.
  bool indented_block() {
    constexpr auto kHeads = std::to_array<std::string_view>(
        {"for", "if", "def", "fn", "else:", "elif", "else", "while"});
    const bool has_colon = tokens_[i_].end > 0 && tokens_.written(i_).ends_with(':');
    const std::uint32_t indent = tokens_[line_].indent;
    if (!has_colon || !is_last_of_line(i_) || !is_one_of(tokens_.written(line_), kHeads) ||
        i_ + 1 >= tokens_.size() || tokens_[i_ + 1].indent <= indent) {
      return false;
    }
    const Span colon{tokens_[i_].end - 1, tokens_[i_].end};
    if (tokens_.is(line_, "def") && tokens_.is(i_ + 1, "return")) {
      auto message = expected(span_of(line_), "`fn`");
      message.help_if(kFunction);
      fix(message, false, span_of(line_), "fn");
      fix(message, false, colon, " =");
      fix(message, false, {colon.end, tokens_[i_ + 1].end}, "");
      return true;
    }
    std::size_t end = i_ + 1;
    while (end < tokens_.size() && (!tokens_[end].is_first || tokens_[end].indent > indent)) ++end;
    auto message = expected(colon, "`{`");
    message.help("a block is in braces");
    fix(message, false, colon, " {");
    if (tokens_.is_bracket(end, '}') && tokens_[end].indent == indent) return true;
    const Edit closing{gap_before(end), fmt::format("\n{}}}", std::string(indent, ' '))};
    add_fix(message, false, where(closing.span), closing.text);
    block_ends_.push_back(closing);
    return true;
  }

  /// `if a then { … }`
  bool then_block() {
    if (!tokens_.is(i_, "then") || !tokens_.is_bracket(i_ + 1, '{')) return false;
    auto message = expected(span_of(i_), "a block in braces");
    message.help("`if … then …` is a value; a statement is `if … { … }`");
    fix(message, false, {span_of(i_).begin, tokens_[i_ + 1].begin}, "");
    return true;
  }

  // Loops. An unknown list is replaced by an empty one: the block is checked, but never run.

  bool loop() {
    if (!tokens_.is(i_, "for")) return false;
    return loop_in_parentheses() || loop_with_bounds() || loop_of();
  }

  /// `for (i in list) {` and `for (int i = 0; i < 3; i++) {`
  bool loop_in_parentheses() {
    const std::size_t open = i_ + 1, close = tokens_.partner(open < tokens_.size() ? open : i_);
    if (!tokens_.is_bracket(open, '(') || !tokens_.is_bracket(close + 1, '{')) return false;
    std::size_t name = open + 1;
    const auto is_in = [&](std::size_t i) { return tokens_.is(i, "in") || tokens_.is(i, "of"); };
    while (name < close && !is_in(name + 1) && !tokens_.is(name + 1, "=")) ++name;
    if (name == close || !tokens_.is_name(name)) return false;
    auto message = report_expected(open, "a name after `for`", false);
    if (is_in(name + 1)) {
      message.help("a loop needs no parentheses: `for i in list { … }`");
      if (tokens_.is(name + 1, "of")) fix(message, false, span_of(name + 1), "in");
      fix(message, false, {tokens_[open].begin, tokens_[name].begin}, "");
      fix(message, false, span_of(close), "");
    } else {
      message.help_if(kNoLoop);
      edit({tokens_[open].begin, tokens_[name].begin}, "");
      edit({tokens_[name].end, tokens_[close].end}, " in []");
      skip_to(close);
    }
    return true;
  }

  /// `for i = 0 to 3 {`
  bool loop_with_bounds() {
    const std::size_t brace = brace_of_line(i_);
    if (!tokens_.is_name(i_ + 1) || !tokens_.is(i_ + 2, "=") || brace >= tokens_.size()) {
      return false;
    }
    auto message = report_expected(i_ + 2, "`in`", false);
    message.help_if(kNoLoop);
    std::size_t to = i_ + 3;
    while (to < brace && !tokens_.is(to, "to")) ++to;
    const Span bounds{tokens_[i_ + 2].begin, tokens_[brace - 1].end};
    if (to > i_ + 3 && to + 1 < brace) {
      message.unsafe_fix(where(bounds),
                         fmt::format("in range({}, {} + 1)", text_of(span_of(i_ + 3, to - 1)),
                                     text_of(span_of(to + 1, brace - 1))));
    }
    edit(bounds, "in []");
    skip_to(brace - 1);
    return true;
  }

  /// `for i of list {`
  bool loop_of() {
    if (!tokens_.is_name(i_ + 1) || !tokens_.is(i_ + 2, "of")) return false;
    auto message = report_expected(i_ + 2, "`in`", false);
    fix(message, false, span_of(i_ + 2), "in");
    return true;
  }

  /// `while a {`
  bool while_loop() {
    const auto habit = find_habit(HabitPlace::StatementWord, tokens_.written(i_));
    if (!habit || habit->help != kNoLoop || tokens_.is_bracket(i_ + 1, '{')) return false;
    const std::size_t brace = brace_of_line(i_);
    if (brace >= tokens_.size()) return false;
    expected(span_of(i_), "a statement").help_if(habit->help);
    edit({tokens_[i_].begin, tokens_[brace - 1].end}, "if true");
    skip_to(brace - 1);
    return true;
  }

  // Functions

  bool is_head(std::size_t word) const {
    return tokens_.is_name(word + 1) && tokens_.is_bracket(word + 2, '(') &&
           tokens_.is_joined(word + 2);
  }

  /// `let f(x) = …`
  bool function_by_let() {
    const bool is_word = tokens_.is(i_, "let") || tokens_.is(i_, "def");
    if (!is_word || !is_head(i_)) return false;
    const std::size_t equals = tokens_.partner(i_ + 2) + 1;
    if (!tokens_.is(equals, "=") || tokens_.is_bracket(equals + 2, '{')) return false;
    auto message = expected(span_of(i_), "`fn`");
    message.help_if(kFunction);
    fix(message, false, span_of(i_), "fn");
    return true;
  }

  /// `function f(x) { return … }`, or with objects in the block.
  bool function_block() {
    const bool is_def = tokens_.is(i_, "def");
    const bool is_foreign = find_habit(HabitPlace::FunctionWord, tokens_.written(i_)).has_value();
    if (!(is_def || is_foreign || tokens_.is(i_, "fn")) || !is_head(i_)) return false;
    const std::size_t open = tokens_.partner(i_ + 2) + 1;
    if (!tokens_.is_bracket(open, '{')) return false;
    const bool returns = tokens_.is(open + 1, "return");
    if (is_def && !returns) return false;
    const std::size_t close = tokens_.partner(open);
    if (close >= tokens_.size() || close == open + 1 + returns) return false;
    for (std::size_t i = open + 1; i < close; ++i) {
      if (tokens_.is_bracket(i, '{') || tokens_.is(i, "for")) return definition_by_function();
      const bool is_statement = tokens_.is(i, "=") || (tokens_.is(i, ";") && i + 1 < close) ||
                                is_one_of(tokens_.written(i), kDeclarationWords);
      if (is_statement) return false;
    }
    const std::size_t body = open + 1 + returns;
    const std::size_t last = close - 1 - tokens_.is(close - 1, ";");
    if (is_foreign) expect_word("fn", false);
    auto message = report_expected(open, "`=` and an expression", false);
    message.help_if(kFunction);
    if (is_def) fix(message, false, span_of(i_), "fn");
    fix(message, false, {tokens_[open].begin, tokens_[body].begin}, "= ");
    fix(message, false, {tokens_[last].end, tokens_[close].end}, "");
    return true;
  }

  /// `function f(x) { sphere { … } }`
  bool definition_by_function() {
    expect_word("def", false);
    return true;
  }

  void expect_word(std::string_view word, bool is_safe) {
    auto message = expected(span_of(i_), fmt::format("`{}`", word));
    fix(message, is_safe, span_of(i_), std::string(word));
  }

  std::size_t line_ = 0;          ///< the first token of the line
  std::vector<Edit> block_ends_;  ///< of indented blocks, the outer ones first
};

}  // namespace

std::vector<Edit> repair_blocks(const RepairContext& context, const TokenList& tokens) {
  return Blocks(context, tokens).run();
}

}  // namespace sdlc::lang
