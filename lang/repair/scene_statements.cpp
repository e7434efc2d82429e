#include <algorithm>
#include <optional>
#include <string>
#include <unordered_set>

#include <fmt/format.h>

#include "lang/repair/property_names.hpp"
#include "lang/repair/scene_round.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

/// Names at the beginning of a statement that are followed by neither `:` nor `{`.
class Statements : private SceneRound {
 public:
  using SceneRound::SceneRound;

  std::vector<Edit> run() {
    walk([this] {
      const bool begins = tokens_.may_begin_statement(i_) || follows_whole_value();
      const bool is_message = tokens_.is(i_ - 1, TokenClass::Comma) && !in_object();
      if (!in_block() || !tokens_.is_name(i_) || !begins || is_message) return;
      if (tokens_.is_bracket(i_ + 1, '(')) {
        call();
      } else if (in_object() && lacks_colon()) {
        auto message =
            report_expected(i_ + 1, fmt::format("`:` or `{{` after `{}`", name()), false);
        fix(message, true, gap_before(i_ + 1), ":");
      }
    });
    return std::move(edits_);
  }

 private:
  std::string_view name() const { return tokens_.written(i_); }
  /// Whether a value that no name continues ends before the token.
  bool follows_whole_value() const {
    const std::size_t last = i_ - 1;
    if (tokens_.is_bracket(last, ')') || tokens_.is_bracket(last, ']')) return true;
    return tokens_.is(last, TokenClass::Value) && !tokens_.is_word(last);
  }

  /// Whether a complete value of the property follows in the line.
  bool lacks_colon() const {
    const std::size_t value = i_ + 1;
    if (!tokens_.is_same_line(value) || !is_property_name(name())) return false;
    const bool opens = tokens_.is_bracket(value, '[');
    if (!opens && !tokens_.is(value, TokenClass::Value)) return false;
    const std::size_t next = (opens ? tokens_.partner(value) : value) + 1;
    if (tokens_.is_name(value) && tokens_.holds_arguments(next)) return tokens_.is_joined(next);
    const bool is_operator = tokens_.is(next, "*") || tokens_.is(next, "+") ||
                             tokens_.is(next, "/") || tokens_.is(next, "^") ||
                             tokens_.is(next, "..");
    return tokens_[next].is_first || tokens_.is(next, TokenClass::Comma) ||
           tokens_.is_bracket(next, '}') || (tokens_.is_number(value) && is_operator);
  }

  /// `name(…)`: a property without its colon, or an object in parentheses.
  void call() {
    const std::size_t open = i_ + 1, close = tokens_.partner(open);
    const bool is_known = is_kind(name()), holds_objects = inside() != Inside::Object;
    const bool is_path = name().find('.') != std::string_view::npos;
    const bool is_labeled = close < tokens_.size() && has_labels(open, close);
    const bool may_be_property = tokens_.is_joined(open) ? is_object_property(name()) : !is_path;
    if (in_object() && !is_labeled && !(holds_objects && is_known) && may_be_property) {
      auto message = report_expected(open, fmt::format("`:` after `{}`", name()), false);
      message.help("a property is `name: value`");
      return fix(message, is_property_name(name()), {tokens_[i_].end, tokens_[i_].end}, ":");
    }
    if (!is_known && !is_path) return;  // the parser reports it
    auto message = report(diag::call_as_statement, span_of(i_), name());
    context_.text.note_reported(where(span_of(i_)).span);
    if (!is_known || !holds_objects) {
      message.help("a call is a value; a value follows `name:` or `let name =`");
    }
    if (!holds_objects) return;
    message.help(fmt::format("an object is `{} {{ … }}`", name()));
    if (!is_labeled || !is_known) return;
    const Span arguments{tokens_[open].end, tokens_[close].begin};
    const bool has_block = tokens_.is_bracket(close + 1, '{');
    add_fix(message, !has_block, where({tokens_[i_].end, tokens_[close].end}),
            fmt::format(" {{ {} }}", text_of(arguments)));
    edit(span_of(open), "{");
    edit(span_of(close), "}");
  }

  /// Whether each of the arguments has a label.
  bool has_labels(std::size_t open, std::size_t close) const {
    bool awaits_label = true;
    for (std::size_t i = open + 1; i < close; ++i) {
      if (awaits_label && !tokens_.is(i, TokenClass::Label)) return false;
      awaits_label = tokens_.is(i, TokenClass::Comma);
      if (tokens_.is(i, TokenClass::Open)) i = std::max(i, tokens_.partner(i));
    }
    return close > open + 1;
  }

  /// Whether it is a kind of object, of the language or of the file.
  bool is_kind(std::string_view name) {
    if (std::ranges::count(all_kinds(), name, &Kind::name) > 0) return true;
    if (!def_names_) {
      def_names_.emplace();
      for (std::size_t i = 0; i < tokens_.size(); ++i) {
        if (tokens_.is(i, "def")) def_names_->insert(tokens_.written(i + 1));
      }
    }
    return def_names_->contains(name);
  }

  std::optional<std::unordered_set<std::string_view>> def_names_;
};

}  // namespace

std::vector<Edit> repair_statements(const RepairContext& context, const TokenList& tokens) {
  return Statements(context, tokens).run();
}

}  // namespace sdlc::lang
