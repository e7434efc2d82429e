#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lang/ast/ast.hpp"
#include "lang/format/format.hpp"
#include "lang/format/layout.hpp"
#include "lang/format/placed_tokens.hpp"
#include "lang/syntax/syntax.hpp"

namespace sdlc::lang {

/// The node after `at`, if there is one.
inline std::optional<ast::Node> next_of(ast::Children::Iterator at, ast::Children::Iterator end) {
  return ++at == end ? std::nullopt : std::optional(*at);
}

/// Walks a tree and composes the layout of its text. The tree determines what follows; the tokens
/// come from the text one by one, each with the comments before it.
class Composer {
 public:
  /// `depth`: of the blocks around the statements.
  Composer(const SyntaxTree& tree, std::uint32_t depth)
      : tree_(tree),
        tokens_(tree.file().text()),
        layout_(tree.file().text()),
        printer_(tree.file().text(), depth * kFormatIndent) {}

  /// The whole file.
  std::string file();

  struct Run {
    std::string text;
    Span replaced;  ///< the text that it replaces, with the spaces around it in its lines
  };
  /// Adjacent statements, each with the comments before it and after it on its line. The first one
  /// begins its line. `begin`: the end of the token before the first one; `next`: the statement
  /// after the last one.
  Run run(std::span<const ast::Node> statements, std::uint32_t begin,
          std::optional<ast::Node> next);

 private:
  // Tokens, and comments and spaces between them

  void token();
  void tokens_until(std::uint32_t end);
  void space_and_token() { layout_.space(), token(); }
  /// `count` tokens with spaces between them.
  void words(int count);
  void comment();
  void leading_comments();
  void trailing_comments();
  void line();
  void soft_line();
  void row_line();
  void space_or_line();
  void comments_before_closer();
  void operator_and_line();

  enum class Comma : std::uint8_t { None, Always, IfFlat, IfBroken };
  void comma(Comma comma);

  // Statements

  void statement(ast::Node statement);
  void separator(ast::Node statement, std::optional<ast::Node> next);
  void property(ast::Node property);
  void type();
  void param(ast::Node param);
  void fn(ast::Node fn);
  void def(ast::Node def);
  void assertion(ast::Node assertion);
  void for_loop(ast::Node loop);
  /// `for names in list`
  void loop_head(ast::Node loop);
  void condition(ast::Node condition);
  void object(ast::Node object);
  void block(ast::Node block, ast::Children::Iterator first);
  void braces(ast::Node block, ast::Children::Iterator first);
  bool is_hugged_block(ast::Children::Iterator first, ast::Children::Iterator end) const;
  void parameters(ast::Node declaration);
  void parameter(ast::Node parameter);

  // Expressions

  void expression(ast::Node node, bool is_aligned = false);
  void assigned(ast::Node value);
  void indented_line(ast::Node value);
  void chain(ast::Node chain, bool is_aligned);
  void power(ast::Node power);
  void let_in(ast::Node let_in);
  void conditional(ast::Node conditional);
  void enclosed(ast::Node value);
  void list(ast::Node list);
  void comprehension(ast::Node list);
  template <typename Contents>
  void bracketed(Contents contents);
  template <typename Elements, typename Compose>
  void sequence(const Elements& elements, bool is_hugged, Compose compose);
  void call(ast::Node call);
  bool is_hugged(ast::Node node, std::uint32_t inside) const;
  void argument(ast::Node argument);
  std::uint32_t skip_spaces(std::uint32_t at) const noexcept;
  char closer_after(ast::Node node) const noexcept;

  const SyntaxTree& tree_;
  PlacedTokens tokens_;
  Layout layout_;
  LayoutPrinter printer_;
};

}  // namespace sdlc::lang
