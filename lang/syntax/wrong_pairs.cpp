#include "lang/syntax/wrong_pairs.hpp"

#include <cstddef>

#include "lang/syntax/scan.hpp"
#include "lang/syntax/vocabulary.hpp"

namespace sdlc::lang {
namespace {

class PairMarker {
 public:
  PairMarker(std::string_view text, std::vector<LayoutToken>& tokens)
      : text_(text), tokens_(tokens) {}

  void run() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < tokens_.size(); ++i) {
      if (tokens_[i].kind == LayoutKind::Open) open.push_back(i);
      if (tokens_[i].kind != LayoutKind::Close || open.empty()) continue;
      if (is_pair(tokens_[open.back()].bracket, tokens_[i].bracket)) check(open.back(), i);
      open.pop_back();
    }
  }

 private:
  static bool is_pair(char open, char close) {
    return (open == '(' && close == ')') || (open == '[' && close == ']') ||
           (open == '{' && close == '}');
  }

  void check(std::size_t open, std::size_t close) {
    if (open < 2 || !is_name(open - 1)) return;
    bool is_one_line = tokens_[open].line == tokens_[close].line;
    for (std::size_t i = open + 1; i < close; ++i) {
      is_one_line = is_one_line && tokens_[i].bracket != '{';
    }
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
