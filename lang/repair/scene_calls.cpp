#include <string>

#include <fmt/format.h>

#include "lang/repair/repair_report.hpp"
#include "lang/text/brackets.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

bool occurs_once(std::string_view text, std::string_view word) {
  int count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    const bool is_whole = (at == 0 || !is_idchar(text[at - 1])) && !is_idchar(char_at(text, end));
    if (is_whole && ++count > 1) return false;
  }
  return true;
}

/// Calls that lack their parenthesis, so that the name has run together with a number:
/// `rgb120, 140, 90)`.
class Calls : private RepairRound {
 public:
  using RepairRound::RepairRound;

  std::vector<Edit> run() {
    if (tokens_.has_matching_brackets()) return {};
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      stop_if_requested();
      const RepairToken& opener = tokens_[tokens_.partner(i)];
      if (tokens_.is_bracket(i, ')') && !is_bracket_pair(opener.bracket, ')')) close(i);
    }
    return std::move(edits_);
  }

 private:
  /// The parenthesis at the token closes nothing: looks for its call in the values before it.
  void close(std::size_t parenthesis) {
    for (std::size_t i = parenthesis; i-- > first_;) {
      if (tokens_.begins_statement(i)) break;
      const std::size_t length = name_length(i);
      if (length == 0) continue;
      const std::uint32_t at = tokens_[i].begin + static_cast<std::uint32_t>(length);
      auto message =
          report(diag::expected, {at, tokens_[i].end},
                 fmt::format("`(` after `{}`, found `{}`", tokens_.written(i).substr(0, length),
                             tokens_.written(i).substr(length)));
      message.label(where(span_of(parenthesis)), "closed here");
      fix(message, false, {at, at}, "(");
      break;
    }
    first_ = parenthesis + 1;
  }

  /// The length of the name before the number; 0 if the token is not both in one.
  std::size_t name_length(std::size_t i) const {
    if (!tokens_.is_name(i)) return 0;
    const std::string_view word = tokens_.written(i);
    const std::size_t length = word.find_last_not_of("0123456789") + 1;
    const bool is_both = length > 1 && length < word.size();
    // A name of the scene that ends in digits occurs where it is declared, too.
    return is_both && occurs_once(tokens_.text(), word) ? length : 0;
  }

  std::size_t first_ = 0;  ///< after the last parenthesis that closes nothing
};

}  // namespace

std::vector<Edit> repair_calls(const RepairContext& context, const TokenList& tokens) {
  return Calls(context, tokens).run();
}

}  // namespace sdlc::lang
