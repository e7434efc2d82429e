#include "lang/syntax/wrong_pairs.hpp"

#include <cstddef>

#include "lang/syntax/vocabulary.hpp"
#include "lang/text/brackets.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

class PairMarker {
 public:
  PairMarker(std::string_view text, std::vector<LayoutToken>& tokens)
      : text_(text), tokens_(tokens) {}

  void run() {
    std::vector<Pair> open;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].kind == LayoutKind::Open) open.push_back({.open = i});
      if (tokens_[i].kind != LayoutKind::Close || open.empty()) continue;
      Pair pair = open.back();
      open.pop_back();
      pair.close = i;
      if (is_bracket_pair(tokens_[pair.open].bracket, tokens_[i].bracket)) check(pair);
      if (!open.empty())
        open.back().has_block |= pair.has_block || tokens_[pair.open].bracket == '{';
    }
  }

 private:
  struct Pair {
    std::size_t open = 0, close = 0;  ///< tokens
    bool has_block = false;           ///< a brace opens inside
  };

  void check(const Pair& pair) {
    const auto [open, close, has_block] = pair;
    if (open < 2 || !is_name(open - 1)) return;
    const bool is_one_line = tokens_[open].line == tokens_[close].line && !has_block;
    const bool are_arguments =
        (tokens_[open].bracket == '{' && is_one_line && is_value(open, close)) ||
        (tokens_[open].bracket == '[' && is_label(open + 1));
    if (are_arguments) return set(open, close, "(", ")");
    const bool begins_line =
        tokens_[open - 1].is_first || (tokens_[open - 2].is_first && is_name(open - 2));
    const bool has_lines = is_label(open + 1) && tokens_[open + 1].is_first;
    if (tokens_[open].bracket == '(' && begins_line && has_lines) set(open, close, "{", "}");
  }

  void set(std::size_t open, std::size_t close, std::string_view opening,
           std::string_view closing) {
    tokens_[open].meant = opening;
    tokens_[open].bracket = opening[0];
    tokens_[close].meant = closing;
    tokens_[close].bracket = closing[0];
  }

  /// Whether the name in front of the brace stands where a value does.
  bool is_value(std::size_t open, std::size_t close) const {
    const LayoutToken& before = tokens_[open - 2];
    if (before.kind == LayoutKind::Label || before.bracket == '(' || before.bracket == '[') {
      return true;
    }
    const bool is_list = word_of(before) == "in";
    return is_list && close + 1 < tokens_.size() && tokens_[close + 1].bracket == '{';
  }

  bool is_label(std::size_t i) const {
    return i < tokens_.size() && tokens_[i].kind == LayoutKind::Label;
  }
  bool is_name(std::size_t i) const {
    return tokens_[i].kind == LayoutKind::Value && is_letter(text_[tokens_[i].begin]) &&
           !is_one_of(word_of(tokens_[i]), kJoints);
  }
  std::string_view word_of(const LayoutToken& token) const {
    return text_.substr(token.begin, token.end - token.begin);
  }

  std::string_view text_;
  std::vector<LayoutToken>& tokens_;
};

}  // namespace

void mark_wrong_pairs(std::string_view text, std::vector<LayoutToken>& tokens) {
  PairMarker(text, tokens).run();
}

}  // namespace sdlc::lang
