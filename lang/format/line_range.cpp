#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lang/format/composer.hpp"
#include "lang/format/format.hpp"

namespace sdlc::lang {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }

/// The statements in a node, and their place.
struct Statements {
  std::vector<ast::Node> nodes;
  std::uint32_t begin = 0;  ///< of the space before the first
};

/// Formats the statements of a file that touch some of its lines.
class LineFormatter {
 public:
  LineFormatter(const SyntaxTree& tree, LineRange lines) : tree_(tree), lines_(lines) {}

  std::string run() {
    Statements all;
    for (const ast::Node child : ast::Node(tree_, 0).children()) all.nodes.push_back(child);
    visit(all, 0);
    result_ += text().substr(copied_);
    return std::move(result_);
  }

 private:
  std::string_view text() const { return tree_.file().text(); }
  std::uint32_t line_of(std::uint32_t at) const { return tree_.file().position(at).line; }
  bool touches(std::uint32_t first, std::uint32_t last) const {
    return first <= lines_.last && last >= lines_.first;
  }

  /// The lines of a statement, with the comments that belong to it.
  LineRange lines_of(ast::Node statement, std::uint32_t gap_begin) const {
    PlacedTokens tokens(text());
    const std::uint32_t begin = tokens.seek_line(gap_begin);
    tokens.seek(statement.span().end);
    std::uint32_t end = statement.span().end;
    if (tokens.peek_text() == ",") end = tokens.take().span.end;
    for (std::size_t i = 0; i < tokens.count_trailing_comments(); ++i) {
      end = tokens.comment(i).span.end;
    }
    return {line_of(begin), line_of(end)};
  }

  std::uint32_t end_of(ast::Node statement) const {
    PlacedTokens tokens(text());
    tokens.seek(statement.span().end);
    return tokens.peek_text() == "," ? tokens.peek().span.end : statement.span().end;
  }

  void visit(const Statements& statements, std::uint32_t depth) {
    const auto& nodes = statements.nodes;
    std::uint32_t begin = statements.begin;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const LineRange lines = lines_of(nodes[i], begin);
      if (touches(lines.first, lines.last) && !visit_inside(nodes[i], depth)) {
        const std::size_t last = end_of_run(nodes, i, lines);
        const bool is_last = last + 1 == nodes.size();
        replace({nodes.data() + i, last + 1 - i}, begin,
                is_last ? std::nullopt : std::optional(nodes[last + 1]), depth);
        i = last;
      }
      begin = end_of(nodes[i]);
    }
  }

  /// The last of the consecutive statements from `first` on that touch the lines or share a line
  /// with one that does.
  std::size_t end_of_run(const std::vector<ast::Node>& nodes, std::size_t first,
                         LineRange lines) const {
    std::size_t last = first;
    for (; last + 1 < nodes.size(); ++last) {
      const LineRange next = lines_of(nodes[last + 1], end_of(nodes[last]));
      const bool is_joined = next.first <= lines.last;
      const bool is_touched =
          touches(next.first, next.last) && blocks_around(nodes[last + 1]).empty();
      if (!is_joined && !is_touched) break;
      lines = next;
    }
    return last;
  }

  /// The blocks of a statement that contain all the lines.
  std::vector<Statements> blocks_around(ast::Node statement) const {
    std::vector<Statements> blocks;
    if (statement.is(SyntaxKind::Object)) {
      add_block(statement, blocks);
    } else {
      for (const ast::Node child : statement.children()) {
        if (child.is(SyntaxKind::Block)) add_block(child, blocks);
      }
    }
    return blocks;
  }

  /// Adds the block if its contents are on separate lines and contain the requested lines.
  void add_block(ast::Node block, std::vector<Statements>& blocks) const {
    Statements inside;
    for (const ast::Node child : block.children()) {
      if (!child.is(SyntaxKind::Name)) inside.nodes.push_back(child);
    }
    if (inside.nodes.empty()) return;
    PlacedTokens tokens(text());
    tokens.seek(block.is(SyntaxKind::Object) ? name_end(block) : block.span().begin);
    inside.begin = tokens.take().span.end;
    const std::uint32_t first = line_of(inside.begin), last = line_of(block.span().end - 1);
    const std::uint32_t inside_first = lines_of(inside.nodes.front(), inside.begin).first;
    const std::uint32_t inside_last =
        lines_of(inside.nodes.back(), inside.nodes.back().span().begin).last;
    const bool is_within = lines_.first > first && lines_.last < last;
    if (is_within && inside_first > first && inside_last < last) {
      blocks.push_back(std::move(inside));
    }
  }

  /// The end of the text before the brace of an object.
  std::uint32_t name_end(ast::Node object) const {
    const auto name = ast::Object{object}.name();
    return name ? name->span().end : object.head_span().end;
  }

  bool visit_inside(ast::Node statement, std::uint32_t depth) {
    const std::vector<Statements> blocks = blocks_around(statement);
    for (const Statements& block : blocks) visit(block, depth + 1);
    return !blocks.empty();
  }

  void replace(std::span<const ast::Node> statements, std::uint32_t begin,
               std::optional<ast::Node> next, std::uint32_t depth) {
    auto [run, replaced] = Composer(tree_, depth).run(statements, begin, next);
    while (replaced.begin > 0 && is_space(text()[replaced.begin - 1])) --replaced.begin;
    const bool begins_line = replaced.begin == 0 || text()[replaced.begin - 1] == '\n';
    if (!begins_line) run.replace(0, run.find_first_not_of(' '), " ");
    const std::size_t line_end = text().find('\n', replaced.end);
    const std::size_t after = text().find_first_not_of(" \t\r", replaced.end);
    const bool ends_line = after == line_end;
    if (ends_line && after != std::string_view::npos) {
      replaced.end = static_cast<std::uint32_t>(after);
      if (text()[after - 1] == '\r') --replaced.end;
    }
    result_ += text().substr(copied_, replaced.begin - copied_);
    result_ += has_crlf() ? with_crlf(run) : run;
    copied_ = replaced.end;
  }

  /// Whether the file has CRLF line ends, which new lines get too.
  bool has_crlf() const {
    const std::size_t first = text().find('\n');
    return first != std::string_view::npos && first > 0 && text()[first - 1] == '\r';
  }
  static std::string with_crlf(std::string_view lines) {
    std::string result;
    for (const char c : lines) {
      if (c == '\n') result += '\r';
      result += c;
    }
    return result;
  }

  const SyntaxTree& tree_;
  LineRange lines_;
  std::string result_;
  std::uint32_t copied_ = 0;  // bytes of the text that are in the result
};

}  // namespace

std::string format_lines(const SyntaxTree& tree, LineRange lines) {
  return LineFormatter(tree, lines).run();
}

}  // namespace sdlc::lang
