#include <algorithm>
#include <initializer_list>
#include <string>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/repair/scene_round.hpp"
#include "lang/repair/vocabulary.hpp"

namespace sdlc::lang {
namespace {

/// Whether one letter was left out, typed twice or wrongly, or swapped with the next.
bool is_one_slip(std::string_view written, std::string_view word) {
  if (written == word || word.size() < 2) return false;
  const auto mismatch = std::mismatch(written.begin(), written.end(), word.begin(), word.end());
  const std::string_view a(mismatch.first, written.end()), b(mismatch.second, word.end());
  if (a.size() == b.size()) {
    const bool is_swapped =
        a.size() > 1 && a[0] == b[1] && a[1] == b[0] && a.substr(2) == b.substr(2);
    return is_swapped || a.substr(1) == b.substr(1);
  }
  return a.size() > b.size() ? a.substr(1) == b : a == b.substr(1);
}

class Words : private SceneRound {
 public:
  using SceneRound::SceneRound;

  std::vector<Edit> run() {
    walk([this] { word(); });
    return std::move(edits_);
  }

 private:
  void word() {
    const std::string_view meant = meant_word();
    if (meant.empty()) return;
    const bool is_definition = tokens_.written(i_).starts_with('#');
    auto message = report(diag::expected, span_of(i_),
                          fmt::format("`{}`, found `{}`", meant, tokens_.written(i_)));
    if (is_definition) {
      message.fix(where(span_of(i_)), std::string(meant));
    } else {
      message.suggest(meant);
    }
    edit(span_of(i_), std::string(meant));
  }

  /// The word of the language that the token was probably meant to be; empty where it may be what
  /// it is.
  std::string_view meant_word() const {
    const bool is_definition = tokens_.written(i_).starts_with("#");
    const bool is_candidate = tokens_.is_name(i_) || is_definition;
    if (!is_candidate || !tokens_.is_same_line(i_ + 1) || i_ + 1 >= tokens_.size()) return {};
    const bool follows_keyword = i_ > 0 && is_one_of(tokens_.written(i_ - 1), kStatementWords);
    const bool follows_value =
        i_ > 0 && !follows_keyword &&
        (tokens_.is(i_ - 1, TokenClass::Value) || tokens_.is(i_ - 1, TokenClass::Close));
    const bool is_else_if = find_habit(HabitPlace::ElseIf, tokens_.written(i_)).has_value();
    if (follows_value && is_else_if) return "else if";
    if (i_ > 0 && tokens_.is_bracket(i_ - 1, '}') && tokens_.is_bracket(i_ + 1, '{')) {
      return slip_of({"else"});
    }
    if (tokens_.may_begin_statement(i_)) return meant_in_statement();
    if (!tokens_.is_same_line(i_)) return {};
    const bool is_loop = i_ > 1 && tokens_.is(i_ - 2, "for") && tokens_.is_name(i_ - 1);
    if (is_loop) return slip_of({"in"});
    if (i_ > 1 && tokens_.is_string(i_ - 1) && tokens_.is(i_ - 2, "import")) return slip_of({"as"});
    const bool precedes_value =
        tokens_.is(i_ + 1, TokenClass::Value) || tokens_.is(i_ + 1, TokenClass::Open);
    if (!follows_value || !precedes_value || tokens_.is_bracket(i_ + 1, '{')) return {};
    return slip_of({"then", "else", "and", "or"});
  }

  std::string_view meant_in_statement() const {
    if (const std::string_view word = meant_by_habit(); !word.empty()) return word;
    const std::size_t next = i_ + 1, third = i_ + 2;
    if (tokens_.is_string(next)) return slip_of({"import", "include"});
    if (tokens_.is(next, TokenClass::Label) && tokens_.is_name(third) && tokens_.is(i_ + 3, "=")) {
      return slip_of({"param"});
    }
    if (!tokens_.is_name(next)) return {};
    if (tokens_.is(third, "=")) return slip_of({"let", "param"});
    if (tokens_.is_bracket(third, '(') && tokens_.is_joined(third)) return slip_of({"fn", "def"});
    if (tokens_.is(third, "in")) return slip_of({"for"});
    return {};
  }

  std::string_view meant_by_habit() const {
    if (!tokens_.is_name(i_ + 1)) return {};
    const HabitPlace place = tokens_.is(i_ + 2, "=")           ? HabitPlace::ValueWord
                             : tokens_.is(i_ + 2, "in")        ? HabitPlace::LoopWord
                             : tokens_.is_bracket(i_ + 2, '(') ? HabitPlace::FunctionWord
                                                               : HabitPlace::Kind;
    if (place == HabitPlace::Kind) return {};
    const std::string_view written = tokens_.written(i_);
    if (const auto habit = find_habit(place, written)) return habit->meant;
    if (place != HabitPlace::FunctionWord) return {};
    const auto definition = find_habit(HabitPlace::DefinitionWord, written);
    return definition ? definition->meant : std::string_view();
  }

  std::string_view slip_of(std::initializer_list<std::string_view> words) const {
    const auto found = std::ranges::find_if(
        words, [&](std::string_view word) { return is_one_slip(tokens_.written(i_), word); });
    return found == words.end() ? std::string_view() : *found;
  }
};

}  // namespace

std::vector<Edit> repair_words(const RepairContext& context, const TokenList& tokens) {
  return Words(context, tokens).run();
}

}  // namespace sdlc::lang
