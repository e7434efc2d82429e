#include "lang/editor/allow_here.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "lang/allowances/allowance_comments.hpp"
#include "lang/ast/statements.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

struct StatementSpan {
  Span span;
  SyntaxKind kind;
};

/// The statements around an offset, the innermost first.
std::vector<StatementSpan> statements_at(const SyntaxTree& tree, std::uint32_t at) {
  std::vector<StatementSpan> statements;
  for (const SyntaxNode& node : tree.nodes()) {
    if (node.begin > at) break;
    if (ast::is_statement(node.kind) && at < node.end)
      statements.push_back({node.span(), node.kind});
  }
  std::ranges::reverse(statements);
  return statements;
}

class AllowanceEdit {
 public:
  AllowanceEdit(const SyntaxTree& tree, std::string_view code)
      : tree_(tree),
        text_(tree.file().text()),
        code_(code),
        comments_(read_allowance_comments(tree, nullptr)) {}

  std::optional<TextEdit> at(std::uint32_t place) const {
    const std::vector<StatementSpan> statements = statements_at(tree_, place);
    for (std::size_t i = 0; i < statements.size(); ++i) {
      const Span span = statements[i].span;
      if (auto edit = added_code(span)) return edit;
      if (is_first_of_line(text_, span.begin)) return line_before(span);
      if (auto edit = end_of_line(span)) return edit;
      // A statement that began on an earlier line has other statements inside.
      const bool is_last =
          i + 1 == statements.size() || begins_earlier(statements[i + 1].span, span);
      if (is_last && statements[i].kind != SyntaxKind::Property) return line_of_its_own(span);
    }
    return std::nullopt;
  }

 private:
  static TextEdit insertion(std::uint32_t at, std::string text) {
    return {.where = {at, at}, .text = std::move(text)};
  }
  std::string comment() const { return fmt::format("// sdlc: allow({})", code_); }

  bool begins_earlier(Span outer, Span inner) const {
    return outer.begin < line_begin(text_, inner.begin);
  }

  /// Adds the code to the comment of the statement, if it has one.
  std::optional<TextEdit> added_code(Span statement) const {
    for (const AllowanceComment& known : comments_) {
      if (known.statement != statement || known.codes.empty()) continue;
      return insertion(known.codes.back().end, fmt::format(", {}", code_));
    }
    return std::nullopt;
  }

  /// A line before the statement and its doc comments, which must be next to it.
  TextEdit line_before(Span statement) const {
    std::uint32_t line = line_begin(text_, statement.begin);
    const std::string indent(text_.substr(line, statement.begin - line));
    const auto comments = tree_.comments();
    auto comment = std::ranges::lower_bound(comments, statement.begin, {},
                                            [](const Comment& each) { return each.span.begin; });
    while (comment != comments.begin() && (--comment)->kind == CommentKind::Doc) {
      const std::uint32_t above = comment->span.begin;
      const bool is_above = line > 0 && line_begin(text_, line - 1) == line_begin(text_, above);
      if (!is_above || !is_first_of_line(text_, above)) break;
      line = line_begin(text_, above);
    }
    return insertion(line, indent + this->comment() + line_end());
  }

  /// A comment after the statement, if nothing but a comment follows it in its line.
  std::optional<TextEdit> end_of_line(Span statement) const {
    TokenReader tokens(text_, statement.end);
    Token next = tokens.next_in_line();
    std::uint32_t end = statement.end;
    if (tokens.text(next) == ",") {
      end = next.span.end;
      next = tokens.next_in_line();
    }
    if (next.kind == TokenKind::LineEnd || next.kind == TokenKind::End) {
      return insertion(end, "  " + comment());
    }
    // The comment that is there becomes the reason.
    if (next.kind == TokenKind::LineComment) return insertion(next.span.begin, comment() + " ");
    return std::nullopt;
  }

  /// Breaks the line before the statement.
  TextEdit line_of_its_own(Span statement) const {
    const std::uint32_t line = line_begin(text_, statement.begin);
    const std::string indent(text_.substr(line, indent_of_line(text_, statement.begin)));
    std::uint32_t begin = statement.begin;
    while (begin > line && (text_[begin - 1] == ' ' || text_[begin - 1] == '\t')) --begin;
    return {.where = {begin, statement.begin},
            .text = fmt::format("{0}{1}{2}{0}{1}", line_end(), indent, comment())};
  }

  std::string line_end() const {
    const std::size_t newline = text_.find('\n');
    const bool has_return =
        newline != std::string_view::npos && newline > 0 && text_[newline - 1] == '\r';
    return has_return ? "\r\n" : "\n";
  }

  const SyntaxTree& tree_;
  std::string_view text_;
  std::string_view code_;
  std::vector<AllowanceComment> comments_;
};

}  // namespace

std::optional<TextEdit> allow_here(const Document& file, const DiagnosticInfo& info,
                                   std::uint32_t at) {
  const bool is_about_allowance =
      info.code == diag::unused_allowance.code || info.code == diag::bad_allowance.code;
  if (info.severity == Severity::Error || is_about_allowance) return std::nullopt;
  if (file.format() != SourceFormat::Scene) return std::nullopt;
  DiagnosticSink ignored;
  return AllowanceEdit(file.tree(ignored), info.code).at(at);
}

}  // namespace sdlc::lang
