#include <string_view>

#include "lang/repair/habits.hpp"
#include "lang/repair/property_names.hpp"
#include "lang/repair/repair_report.hpp"
#include "lang/repair/vocabulary.hpp"
#include "lang/schema/type_names.hpp"

namespace sdlc::lang {
namespace {

class Marks : private RepairRound {
 public:
  using RepairRound::RepairRound;

  std::vector<Edit> run() {
    for (i_ = 0; i_ < tokens_.size(); ++i_) {
      stop_if_requested();
      if (is_between_values()) look();
      if (tokens_.is(i_, TokenClass::Open)) {
        open_.push_back({.opener = i_});
      } else if (tokens_.is(i_, TokenClass::Close) && !open_.empty()) {
        open_.pop_back();
      }
    }
    return std::move(edits_);
  }

 private:
  struct Open {
    std::size_t opener = 0;
    std::uint32_t commas = 0;
    bool has_fault = false;
    bool has_loop = false;  ///< a `for` of a comprehension, after which no value lacks a comma
  };

  bool is_call() const { return tokens_.holds_arguments(open_.back().opener) && !is_head(); }
  bool is_head() const { return tokens_.holds_parameters(open_.back().opener); }
  /// Whether the parenthesis is a point or a part of a formula.
  bool is_plain() const {
    return tokens_.is_bracket(open_.back().opener, '(') && !is_call() && !is_head();
  }

  bool is_between_values() const {
    if (open_.empty() || tokens_.is_bracket(open_.back().opener, '{')) return false;
    const std::size_t opener = open_.back().opener;
    const std::size_t closer = tokens_.partner(opener);
    const bool is_loop = opener > 0 && (tokens_.is(opener - 1, "for") ||
                                        (closer < tokens_.size() && tokens_.is(closer + 1, "in")));
    return !is_loop && !is_added(i_) && !is_added(i_ - 1);
  }

  void look() {
    Open& open = open_.back();
    // A point has three values: a fourth is too much, and lacks no comma.
    const bool is_full = is_plain() && open.commas > 1;
    open.has_loop = open.has_loop || tokens_.is(i_, "for");
    if (i_ != open.opener + 1 && !is_full && !open.has_loop && is_apart()) {
      open.has_fault = true;
      missing_mark(lacks_colon());
    }
    if (tokens_.is(i_, TokenClass::Comma)) ++open.commas;
    const bool is_pair = tokens_.is(i_, TokenClass::Close) && is_plain() && open.commas == 1 &&
                         !tokens_.is(i_ - 1, TokenClass::Comma);
    if (!is_pair) return;
    if (!open.has_fault) report_expected(i_, "`,` and a third value: a point has three", true);
    open.has_fault = true;
    edit(gap_before(i_), ", 0");
  }

  /// Whether something is missing between the token and the value before it.
  bool is_apart() const {
    const std::size_t before = i_ - 1;
    if (tokens_.is_joined(i_)) return false;
    const bool follows_value = tokens_.is(before, TokenClass::Value) ||
                               tokens_.is_bracket(before, ')') || tokens_.is_bracket(before, ']');
    const auto is_joint = [&](std::size_t i) {
      return tokens_.is_word(i) && (is_one_of(tokens_.written(i), kJoints) || tokens_.is(i, "let"));
    };
    if (!follows_value || is_joint(before) || is_joint(i_)) return false;
    if (tokens_.is(i_, TokenClass::Label)) return true;
    if (tokens_.is_bracket(i_, '(')) return !tokens_.is_name(before);
    if (!tokens_.is(i_, TokenClass::Value)) return false;
    // `2 m` is a mistake of another kind.
    const bool is_unit = tokens_.is_name(i_) && !tokens_.is_bracket(i_ + 1, '(') &&
                         !tokens_.is(i_ + 1, TokenClass::Value);
    return !tokens_.is_number(before) || !is_unit;
  }

  /// Whether the token before may be the name of an argument, or a type follows it.
  bool lacks_colon() {
    const bool may_be_label = tokens_.is_name(i_ - 1) && (tokens_.is(i_ - 2, TokenClass::Comma) ||
                                                          tokens_.is(i_ - 2, TokenClass::Open));
    const bool is_label =
        may_be_label && (is_call() || (is_head() && is_type_name(tokens_.written(i_))));
    if (!is_label) ++open_.back().commas;
    return is_label;
  }

  void missing_mark(bool is_colon) {
    const std::size_t opener = open_.back().opener;
    const std::string_view words = is_colon && is_head()             ? "`:` and a type"
                                   : is_colon                        ? "`:` or `,`"
                                   : tokens_.is_bracket(opener, '[') ? "`,` or `]`"
                                   : is_plain()                      ? "`)`"
                                                                     : "`,` or `)`";
    auto message = report_expected(i_, words, true);
    const Span gap = gap_before(i_);
    edit(gap, is_colon ? ":" : ",");
    const std::string_view first = tokens_.written(i_ - 1);
    if (is_head() &&
        (is_colon || is_type_name(first) || find_habit(HabitPlace::ValueWord, first))) {
      message.help("a parameter is `name: type`");
      if (is_colon) add_fix(message, !is_type_name(first), where(gap), ":");
    } else if (is_colon) {
      message.help("an argument is `name: value`");
      if (is_property_name(first)) message.unsafe_fix(where(gap), ":");
    } else {
      message.label(where(span_of(opener)), "opened here").help("separate values with commas");
      add_fix(message, is_certain_comma(), where(gap), ",");
    }
  }

  /// Whether only a comma can be missing: before the next label of a call, or between numbers of
  /// which there are three.
  bool is_certain_comma() const {
    const std::size_t opener = open_.back().opener;
    if (is_call()) return tokens_.is(i_, TokenClass::Label) && ends_value(i_ - 1);
    if (!tokens_.is_bracket(opener, '(') || is_head()) return false;
    std::uint32_t numbers = 0;
    for (std::size_t i = opener + 1; i < tokens_.size(); ++i) {
      if (tokens_.is(i, TokenClass::Close)) return numbers == 3;
      if (tokens_.is(i, TokenClass::Comma) || tokens_.is(i, "-")) continue;
      if (!tokens_.is_number(i) || ++numbers > 3) return false;
    }
    return false;
  }

  /// Whether no value goes on after the token, and none is a mere name.
  bool ends_value(std::size_t i) const {
    if (tokens_.is(i, TokenClass::Close)) return true;
    const bool is_literal = tokens_.is(i, TokenClass::Value) && !tokens_.is_word(i);
    return is_literal || tokens_.is(i - 1, TokenClass::Label);
  }

  std::size_t i_ = 0;
  std::vector<Open> open_;
};

}  // namespace

std::vector<Edit> repair_marks(const RepairContext& context, const TokenList& tokens) {
  return Marks(context, tokens).run();
}

}  // namespace sdlc::lang
