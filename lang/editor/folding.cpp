#include "lang/editor/folding.hpp"

#include <algorithm>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/editor/bracket_pairs.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

bool has_line_end(std::string_view text) { return text.find('\n') != std::string_view::npos; }

/// Joins line comments of one kind that are alone on successive lines.
class CommentRuns {
 public:
  explicit CommentRuns(std::vector<FoldingRange>& ranges) : ranges_(ranges) {}

  void add(const Token& comment, std::uint32_t line) {
    const bool continues = is_open_ && comment.kind == kind_ && line == last_line_ + 1;
    if (!continues) {
      end();
      run_.begin = comment.span.begin;
      first_line_ = line;
    }
    run_.end = comment.span.end;
    last_line_ = line;
    kind_ = comment.kind;
    is_open_ = true;
  }

  void end() {
    if (is_open_ && last_line_ > first_line_) ranges_.push_back({run_, FoldingKind::Comment});
    is_open_ = false;
  }

 private:
  std::vector<FoldingRange>& ranges_;
  Span run_;
  std::uint32_t first_line_ = 0, last_line_ = 0;
  TokenKind kind_ = TokenKind::LineComment;
  bool is_open_ = false;
};

void add_comments(std::vector<FoldingRange>& ranges, const SourceFile& file) {
  CommentRuns runs(ranges);
  TokenReader tokens(file.text(), 0, file.format());
  std::uint32_t line = 0;
  bool is_first_of_line = true;
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    switch (token.kind) {
      case TokenKind::Space: break;
      case TokenKind::LineEnd:
        ++line;
        is_first_of_line = true;
        break;
      case TokenKind::LineComment:
      case TokenKind::DocComment:
        if (is_first_of_line) runs.add(token, line);
        break;
      case TokenKind::BlockComment: {
        const std::string_view text = tokens.text(token);
        if (has_line_end(text)) ranges.push_back({token.span, FoldingKind::Comment});
        line += static_cast<std::uint32_t>(std::ranges::count(text, '\n'));
        is_first_of_line = false;
        break;
      }
      default: is_first_of_line = false;
    }
  }
  runs.end();
}

void add_imports(std::vector<FoldingRange>& ranges, const SyntaxTree& tree) {
  Span run;
  const auto end_run = [&] {
    if (has_line_end(tree.text(run))) ranges.push_back({run, FoldingKind::Imports});
    run = {};
  };
  for (const ast::Node statement : ast::Node(tree, 0).children()) {
    if (statement.is(SyntaxKind::Import) || statement.is(SyntaxKind::Include)) {
      if (run.size() == 0) run.begin = statement.span().begin;
      run.end = statement.span().end;
    } else {
      end_run();
    }
  }
  end_run();
}

void keep_largest(std::vector<FoldingRange>& ranges, std::size_t max_count) {
  if (ranges.size() <= max_count) return;
  const auto is_larger = [](const FoldingRange& a, const FoldingRange& b) {
    return a.hidden.size() > b.hidden.size();
  };
  const auto end = ranges.begin() + static_cast<std::ptrdiff_t>(max_count);
  std::nth_element(ranges.begin(), end, ranges.end(), is_larger);
  ranges.erase(end, ranges.end());
}

}  // namespace

std::vector<FoldingRange> folding_ranges(const SourceFile& file, const SyntaxTree* tree,
                                         std::size_t max_count) {
  std::vector<FoldingRange> ranges;
  for (const BracketPair& pair : bracket_pairs(file.text(), file.format())) {
    if (pair.is_closed() && pair.spans_lines) ranges.push_back({pair.inside()});
  }
  add_comments(ranges, file);
  if (tree != nullptr) add_imports(ranges, *tree);
  keep_largest(ranges, max_count);
  std::ranges::sort(ranges, {}, [](const FoldingRange& range) { return range.hidden.begin; });
  return ranges;
}

}  // namespace sdlc::lang
