#include "lang/allowances/allowance_comments.hpp"

#include <algorithm>
#include <cstdint>
#include <string_view>

#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kMark = "sdlc:";

bool is_statement(SyntaxKind kind) {
  return kind >= SyntaxKind::Property && kind <= SyntaxKind::Object;
}

/// The tokens of a line comment after its `//`.
TokenReader content_of(std::string_view text, Span comment) {
  return TokenReader(text.substr(0, comment.end), comment.begin + 2);
}

/// Consumes `sdlc:`, the beginning of an allowance.
bool take_mark(TokenReader& tokens) {
  return tokens.text(tokens.next_in_line()) == "sdlc" && tokens.text(tokens.next()) == ":";
}

/// The codes of `// sdlc: allow(W402, W4) reason`; empty if the comment has another form.
std::vector<Span> read_codes(TokenReader tokens) {
  const auto next = [&] { return tokens.text(tokens.next_in_line()); };
  if (!take_mark(tokens) || next() != "allow" || next() != "(") return {};
  std::vector<Span> codes;
  std::string_view separator;
  do {
    const Token code = tokens.next_in_line();
    if (code.kind != TokenKind::Name && code.kind != TokenKind::Number) return {};
    codes.push_back(code.span);
    separator = next();
  } while (separator == ",");
  return separator == ")" ? codes : std::vector<Span>();
}

/// Finds the statements of all comments in one pass over the tree.
class Statements {
 public:
  Statements(const SyntaxTree& tree, const StopRequest* stop)
      : tree_(tree), text_(tree.file().text()) {
    find_next_tokens(stop);
    find_parts(stop);
  }

  std::optional<Span> of_comment(std::size_t comment) const {
    const Span span = tree_.comments()[comment].span;
    const std::size_t line_break = text_.substr(0, span.begin).rfind('\n');
    const auto line = static_cast<std::uint32_t>(line_break + 1);  // npos + 1 is 0
    const bool is_alone = std::ranges::all_of(text_.substr(line, span.begin - line), is_blank);
    return is_alone ? beginning_at(next_tokens_[comment]) : ending_before(span.begin, line);
  }

 private:
  /// A statement or a block.
  struct Part {
    Span span;
    bool is_block;
    std::uint32_t around;  ///< index of the enclosing part; kNone for the file
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  /// Finds the first token after each comment.
  void find_next_tokens(const StopRequest* stop) {
    const auto comments = tree_.comments();
    next_tokens_.resize(comments.size());
    for (std::size_t i = comments.size(); i-- > 0;) {
      stop_if_requested(stop);
      std::uint32_t at = comments[i].span.end;
      while (at < text_.size() && is_blank(text_[at])) ++at;
      const bool is_comment = i + 1 < comments.size() && comments[i + 1].span.begin == at;
      next_tokens_[i] = is_comment ? next_tokens_[i + 1] : at;
    }
  }

  void find_parts(const StopRequest* stop) {
    std::uint32_t around = kNone;
    for (const SyntaxNode& node : tree_.nodes()) {
      stop_if_requested(stop);
      const bool is_block = node.kind == SyntaxKind::Block;
      if (!is_statement(node.kind) && !is_block) continue;
      while (around != kNone && parts_[around].span.end <= node.begin)
        around = parts_[around].around;
      parts_.push_back({.span = node.span(), .is_block = is_block, .around = around});
      around = static_cast<std::uint32_t>(parts_.size() - 1);
    }
  }

  std::optional<Span> beginning_at(std::uint32_t token) const {
    const auto found = std::ranges::lower_bound(parts_, token, {},
                                                [](const Part& part) { return part.span.begin; });
    const bool is_found = found != parts_.end() && found->span.begin == token && !found->is_block;
    return is_found ? std::optional(found->span) : std::nullopt;
  }

  std::optional<Span> ending_before(std::uint32_t comment, std::uint32_t line) const {
    const auto after = std::ranges::lower_bound(parts_, comment, {},
                                                [](const Part& part) { return part.span.begin; });
    if (after == parts_.begin()) return std::nullopt;
    auto around = static_cast<std::uint32_t>(after - parts_.begin() - 1);
    std::optional<Span> before;
    for (; around != kNone && parts_[around].span.end <= comment; around = parts_[around].around) {
      before = parts_[around].span;
    }
    if (before && before->end > line) return before;
    while (around != kNone && parts_[around].is_block) around = parts_[around].around;
    return around == kNone ? std::nullopt : std::optional(parts_[around].span);
  }

  const SyntaxTree& tree_;
  std::string_view text_;
  std::vector<std::uint32_t> next_tokens_;  // by comment
  std::vector<Part> parts_;                 // by beginning, outer ones first
};

}  // namespace

bool may_have_allowances(std::string_view text) noexcept {
  return text.find(kMark) != std::string_view::npos;
}

std::vector<AllowanceComment> read_allowance_comments(const SyntaxTree& tree,
                                                      const StopRequest* stop) {
  const std::string_view text = tree.file().text();
  if (!may_have_allowances(text)) return {};
  const Statements statements(tree, stop);
  std::vector<AllowanceComment> allowances;
  for (std::size_t i = 0; i < tree.comments().size(); ++i) {
    stop_if_requested(stop);
    const Comment& comment = tree.comments()[i];
    if (comment.kind != CommentKind::Line) continue;
    const TokenReader content = content_of(text, comment.span);
    if (TokenReader tokens = content; !take_mark(tokens)) continue;
    allowances.push_back({.comment = comment.span,
                          .codes = read_codes(content),
                          .statement = statements.of_comment(i)});
  }
  return allowances;
}

}  // namespace sdlc::lang
