#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "lang/format/format.hpp"
#include "lang/format/placed_tokens.hpp"

namespace sdlc::lang {
namespace {

/// A comment and the number of tokens before it, except commas and operators, which may move to its
/// other side.
struct CountedComment {
  std::size_t tokens = 0;
  Span span;
};

bool is_operator(std::string_view token) {
  if (token.empty()) return false;
  switch (token[0]) {
    case '+':
    case '-':
    case '*':
    case '/':
    case '<':
    case '>': return true;
    case '=':
    case '!': return token.size() == 2;
    case '.': return token == "..";
    case 'a': return token == "and";
    case 'o': return token == "or";
    default: return false;
  }
}

/// The tokens of a tree without its commas.
class ProgramReader {
 public:
  explicit ProgramReader(const SyntaxTree& tree) : tree_(tree), tokens_(tree.file().text()) {}

  /// Empty at the end.
  std::string_view next() {
    std::string_view token;
    do {
      while (tokens_.has_comments()) comments_.push_back({count_, tokens_.take_comment().span});
      token = tokens_.peek_text();
      if (!token.empty()) tokens_.take();
    } while (token == ",");
    if (!is_operator(token)) ++count_;
    return token;
  }

  const std::vector<CountedComment>& comments() const { return comments_; }
  std::string_view text(const CountedComment& comment) const { return tree_.text(comment.span); }

 private:
  const SyntaxTree& tree_;
  PlacedTokens tokens_;
  std::size_t count_ = 0;
  std::vector<CountedComment> comments_;
};

bool is_same_token(std::string_view a, std::string_view b) {
  const auto adds_zero = [](std::string_view bare, std::string_view whole) {
    return bare.size() > 1 && bare[0] == '.' && bare[1] != '.' && whole.size() == bare.size() + 1 &&
           whole[0] == '0' && whole.substr(1) == bare;
  };
  return a == b || adds_zero(a, b) || adds_zero(b, a);
}

/// A comment without the characters that the formatter removes.
std::string bare_comment(std::string_view comment) {
  std::string bare(comment);
  std::erase(bare, '\r');
  if (bare.starts_with("//")) bare.erase(bare.find_last_not_of(" \t") + 1);
  return bare;
}

bool have_same_structure(const SyntaxTree& a, const SyntaxTree& b) {
  return std::ranges::equal(a.nodes(), b.nodes(), [](const SyntaxNode& x, const SyntaxNode& y) {
    return x.kind == y.kind && x.op == y.op && x.extent == y.extent;
  });
}

bool have_same_comments(const ProgramReader& a, const ProgramReader& b) {
  return std::ranges::equal(
      a.comments(), b.comments(), [&](const CountedComment& x, const CountedComment& y) {
        return x.tokens == y.tokens && bare_comment(a.text(x)) == bare_comment(b.text(y));
      });
}

}  // namespace

bool is_same_program(const SyntaxTree& a, const SyntaxTree& b) {
  if (!have_same_structure(a, b)) return false;
  ProgramReader tokens_a(a), tokens_b(b);
  for (;;) {
    const std::string_view token = tokens_a.next();
    if (!is_same_token(token, tokens_b.next())) return false;
    if (token.empty()) return have_same_comments(tokens_a, tokens_b);
  }
}

}  // namespace sdlc::lang
