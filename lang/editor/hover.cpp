#include "lang/editor/hover.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/editor/cursor.hpp"
#include "lang/editor/hover_symbol.hpp"
#include "lang/editor/hover_text.hpp"
#include "lang/editor/keywords.hpp"
#include "lang/editor/values.hpp"
#include "lang/explain/explain.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/text/ascii.hpp"
#include "lang/token/token_reader.hpp"
#include "lang/value/literals.hpp"

namespace sdlc::lang {
namespace {

/// The code of an allowance, such as `W402` in `// sdlc: allow(W402)`, at the offset.
std::optional<Span> allowed_code_at(std::string_view text, Span comment, std::uint32_t offset) {
  if (text.substr(comment.begin, comment.size()).find("sdlc:") == std::string_view::npos) return {};
  TokenReader tokens(text.substr(0, comment.end), comment.begin + 2);
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (offset < token.span.begin || offset > token.span.end) continue;
    if (token.kind == TokenKind::Name) return token.span;
  }
  return {};
}

/// The page with only the languages after its fences: editors know scenes as `scene`.
std::string with_plain_fences(std::string_view page) {
  std::string text;
  while (!page.empty()) {
    const std::size_t end = std::min(page.find('\n'), page.size() - 1) + 1;
    std::string_view line = page.substr(0, end);
    page.remove_prefix(end);
    if (line.starts_with("```rust scene")) {
      text += "```scene\n";
    } else if (line.starts_with("```") && line.find(' ') != std::string_view::npos) {
      text.append(line.substr(0, line.find(' '))).push_back('\n');
    } else {
      text += line;
    }
  }
  return text;
}

/// The page of a code, or the titles of the codes that begin with it.
std::string explanation_of(std::string_view code) {
  if (const auto page = explanation(code)) return with_plain_fences(*page);
  std::string codes;
  for (const DiagnosticInfo* info : all_diagnostics()) {
    if (code.size() < 2 || !info->code.starts_with(code)) continue;
    codes += fmt::format("* {}: {}\n", info->code, title_of(*info));
  }
  return codes;
}

bool is_expression(SyntaxKind kind) {
  return kind >= SyntaxKind::Conditional && kind != SyntaxKind::Argument &&
         kind != SyntaxKind::Member && kind != SyntaxKind::Index;
}

class HoverQuery {
 public:
  HoverQuery(SceneView& view, std::uint32_t file, std::uint32_t offset, Cursor cursor)
      : view_(view), file_(file), offset_(offset), cursor_(std::move(cursor)), values_(view) {}

  std::optional<Hover> run() {
    const Span where = add_all();
    if (text_.is_empty()) return std::nullopt;
    return Hover{where, text_.take()};
  }

 private:
  ast::Node inner() const { return cursor_.nodes.back(); }
  std::string_view source() const { return view_.file(file_).text(); }
  std::string_view token_text() const { return view_.file(file_).text(cursor_.token.span); }

  /// Returns the place that is described.
  Span add_all();
  Span add_comment();
  Span add_name();
  Span add_literal();
  Span add_path();
  Span add_expression();
  /// The property or argument whose value is the number or colour; null if there is none.
  const BuiltinSymbol* property_of_literal() const;

  SceneView& view_;
  std::uint32_t file_;
  std::uint32_t offset_;
  Cursor cursor_;
  Values values_;
  HoverText text_;
};

Span HoverQuery::add_all() {
  switch (cursor_.token.kind) {
    case TokenKind::LineComment: return add_comment();
    case TokenKind::Name: return add_name();
    case TokenKind::Number:
    case TokenKind::Color: return add_literal();
    case TokenKind::String: return add_path();
    case TokenKind::Mark:
    case TokenKind::Open:
    case TokenKind::Close: return add_expression();
    default: return {};
  }
}

Span HoverQuery::add_comment() {
  const auto code = allowed_code_at(source(), cursor_.token.span, offset_);
  if (!code) return {};
  text_.add(explanation_of(upper_case(view_.file(file_).text(*code))));
  return *code;
}

Span HoverQuery::add_name() {
  const Occurrence* name = view_.table(file_).at(cursor_.token.span.begin);
  const bool is_here = name != nullptr && name->where == cursor_.token.span;
  if (is_here && name->symbol.is_known()) {
    describe_symbol(view_, file_, cursor_, name->symbol, values_, text_);
    return name->where;
  }
  if (is_here) return {};
  // A component of a value: `point.x`.
  if (inner().is(SyntaxKind::Reference) || inner().is(SyntaxKind::Member)) return add_expression();
  const bool is_label = has_colon_after(source(), cursor_.token.span.end);
  const Keyword* keyword = is_label ? nullptr : find_keyword(token_text());
  if (keyword == nullptr) return {};
  text_.add_code(keyword->form);
  text_.add(keyword->doc);
  return cursor_.token.span;
}

Span HoverQuery::add_literal() {
  if (!is_expression(inner().kind())) return {};
  const BuiltinSymbol* owner = property_of_literal();
  const Property* property = owner == nullptr ? nullptr : owner->property;
  const ComputedValue value = as_value_of(property, values_.of_expression(file_, inner()));
  text_.add(describe_value(value, values_, token_text()));
  if (property == nullptr) return cursor_.token.span;
  text_.add(fmt::format("{}: {}", as_code(owner->name), describe(*property)));
  text_.add(owner->doc);
  return cursor_.token.span;
}

const BuiltinSymbol* HoverQuery::property_of_literal() const {
  const std::size_t depth = cursor_.nodes.size();
  if (depth < 2) return nullptr;
  const ast::Node parent = cursor_.nodes[depth - 2];
  if (!parent.is(SyntaxKind::Property) && !parent.is(SyntaxKind::Argument)) return nullptr;
  const Occurrence* label = view_.table(file_).at(parent.span().begin);
  if (label == nullptr || !label->symbol.is_builtin()) return nullptr;
  const BuiltinSymbol& builtin = builtin_symbols()[label->symbol.index];
  return builtin.property == nullptr ? nullptr : &builtin;
}

/// The file of an import or include.
Span HoverQuery::add_path() {
  const bool has_parent = cursor_.nodes.size() > 1 && inner().is(SyntaxKind::String);
  if (!has_parent) return {};
  const ast::Node parent = cursor_.nodes[cursor_.nodes.size() - 2];
  if (!parent.is(SyntaxKind::Import) && !parent.is(SyntaxKind::Include)) return {};
  DiagnosticSink ignored;
  const Value name = evaluate_string(inner(), ignored);
  const auto* relative = get_if<std::string>(&name);
  if (relative == nullptr) return {};
  const std::filesystem::path path = view_.module(file_).path.parent_path() / *relative;
  text_.add(fmt::format("File: {}", as_code(path.lexically_normal().generic_string())));
  return cursor_.token.span;
}

/// The innermost expression around the cursor.
Span HoverQuery::add_expression() {
  const std::size_t depth = cursor_.nodes.size();
  ast::Node node = inner();
  const bool is_part = node.is(SyntaxKind::Member) || node.is(SyntaxKind::Index);
  if (is_part && depth > 1) node = cursor_.nodes[depth - 2];
  if (!is_expression(node.kind())) return {};
  text_.add(describe_value(values_.of_expression(file_, node), values_, node.text()));
  return node.span();
}

}  // namespace

std::optional<Hover> hover(SceneView& view, std::uint32_t file, std::uint32_t offset) {
  const SyntaxTree& tree = view.tree(file);
  Cursor word = cursor_at(tree, offset), next = cursor_on(tree, offset);
  const bool is_same = word.token.span == next.token.span;
  auto found = HoverQuery(view, file, offset, std::move(word)).run();
  if (found || is_same) return found;
  return HoverQuery(view, file, offset, std::move(next)).run();
}

std::string to_plain_text(std::string_view markdown) {
  std::string text;
  while (!markdown.empty()) {
    const std::size_t end = std::min(markdown.find('\n'), markdown.size());
    const std::string_view line = markdown.substr(0, end);
    markdown.remove_prefix(std::min(end + 1, markdown.size()));
    if (!line.starts_with("```")) text.append(line).push_back('\n');
  }
  std::erase(text, '`');
  while (text.ends_with('\n')) text.pop_back();
  return text;
}

}  // namespace sdlc::lang
