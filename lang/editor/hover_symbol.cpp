#include "lang/editor/hover_symbol.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/ast/statements.hpp"
#include "lang/editor/data_columns.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/resolve/symbol_types.hpp"
#include "lang/schema/find_kind.hpp"
#include "lang/token/token_reader.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

/// `fn name(…)` or `def name(…)`, without the body.
std::string_view signature_of(ast::Node statement) {
  const std::string_view text = statement.text();
  TokenReader tokens(text);
  int depth = 0;
  for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
    if (token.kind == TokenKind::Open) ++depth;
    if (token.kind == TokenKind::Close && --depth == 0) return text.substr(0, token.span.end);
  }
  return text;
}

/// What the code block shows of a declaration.
std::string declaration_text(ast::Node node, const Symbol& symbol) {
  const std::string_view text = node.text();
  switch (symbol.kind) {
    case SymbolKind::Fn: {
      constexpr std::size_t kMaxBytes = 200;
      if (text.size() <= kMaxBytes && text.find('\n') == std::string_view::npos) break;
      return std::string(signature_of(node)) + " = …";
    }
    case SymbolKind::Def: return std::string(signature_of(node));
    case SymbolKind::LoopVariable: {
      const ast::Node loop(node.tree(), symbol.owner);
      const auto list = loop.child(1);
      const std::uint32_t end = list ? list->span().end : symbol.where.end;
      return std::string(node.tree().text({loop.span().begin, end}));
    }
    case SymbolKind::Object:
      return std::string(node.tree().text({node.span().begin, symbol.where.end}));
    default: break;
  }
  return std::string(text);
}

/// The head of the object or call around the cursor: the owner of a property.
std::string_view owner_of(const Cursor& cursor) {
  for (auto node = cursor.nodes.rbegin(); node != cursor.nodes.rend(); ++node) {
    if (node->is(SyntaxKind::Object) || node->is(SyntaxKind::Call)) return node->head();
  }
  return {};
}

/// The property or argument that the cursor's name is the label of.
std::optional<ast::Node> labeled_at(const Cursor& cursor) {
  const ast::Node inner = cursor.nodes.back();
  const bool is_labeled = inner.is(SyntaxKind::Property) || inner.is(SyntaxKind::Argument);
  const bool is_label = is_labeled && cursor.token.span.begin == inner.span().begin;
  return is_label ? std::optional(inner) : std::nullopt;
}

/// The text of the `///` comments before the first statement.
std::string documentation_of_file(const SyntaxTree& tree) {
  const std::uint32_t end = skip_space(tree.file().text(), 0);
  std::string documentation;
  for (const Comment& comment : tree.comments()) {
    if (comment.span.begin >= end) break;
    if (comment.kind != CommentKind::Doc) continue;
    std::string_view line = tree.text(comment.span).substr(std::string_view("///").size());
    if (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with('\r') || line.ends_with('\n')) line.remove_suffix(1);
    documentation += fmt::format("{}{}", documentation.empty() ? "" : "\n", line);
  }
  return documentation;
}

std::string join_names(std::span<const Property> properties) {
  std::vector<std::string> names;
  for (const Property& property : properties) names.push_back(as_code(property.name));
  return fmt::format("{}", fmt::join(names, ", "));
}

/// A line for each.
std::string describe_parameters(std::span<const Property> parameters) {
  std::string text;
  for (const Property& parameter : parameters) {
    text += fmt::format("{}* {}: {}. {}", text.empty() ? "" : "\n", as_code(parameter.name),
                        describe(parameter), parameter.doc);
  }
  return text;
}

class Description {
 public:
  Description(SceneView& view, std::uint32_t file, const Cursor& cursor, Values& values,
              HoverText& text)
      : view_(view), file_(file), cursor_(cursor), values_(values), text_(text) {}

  void add(SymbolId id) {
    if (id.is_builtin()) {
      add_builtin(builtin_symbols()[id.index]);
    } else if (const Symbol* symbol = view_.index().find(id)) {
      add_declared(id, *symbol);
    }
  }

 private:
  void add_declared(SymbolId id, const Symbol& symbol);
  void add_import(SymbolId id, const Symbol& symbol);
  void add_table(const Table& table);
  void add_type(SymbolId id);
  void add_loop(SymbolId id, const Symbol& symbol);
  void add_builtin(const BuiltinSymbol& builtin);
  void add_function(const BuiltinSymbol& builtin);
  void add_kind(const Kind& kind);
  void add_property(const Property& property);
  void add_value(ast::Node expression, const Property* property = nullptr);
  void add_value_of_call();

  SceneView& view_;
  std::uint32_t file_;
  const Cursor& cursor_;
  Values& values_;
  HoverText& text_;
};

void Description::add_value(ast::Node expression, const Property* property) {
  const ComputedValue value =
      as_value_of(property, values_.of_expression(file_, expression, property));
  text_.add(describe_value(value, values_, expression.text()));
}

/// The value of the call whose callee is the cursor's name.
void Description::add_value_of_call() {
  const ast::Node inner = cursor_.nodes.back();
  if (inner.is(SyntaxKind::Call)) add_value(inner);
}

// Symbols that a file declares

void Description::add_declared(SymbolId id, const Symbol& symbol) {
  const ast::Node node(view_.tree(id.file), symbol.node);
  text_.add_code(declaration_text(node, symbol));
  const auto written = ast::expression_of(node);
  switch (symbol.kind) {
    case SymbolKind::Let:
    case SymbolKind::Param:
      text_.add(describe_value(values_.of_symbol(id), values_,
                               written ? written->text() : std::string_view()));
      add_type(id);
      break;
    case SymbolKind::Parameter: {
      const ast::Node owner(view_.tree(id.file), symbol.owner);
      text_.add(fmt::format("Parameter of {}.", as_code(ast::declared_name(owner))));
      if (const auto labeled = labeled_at(cursor_)) {
        if (const auto value = ast::Labeled{*labeled}.value()) add_value(*value);
      }
      break;
    }
    case SymbolKind::Fn: add_value_of_call(); break;
    case SymbolKind::LoopVariable: add_loop(id, symbol); break;
    case SymbolKind::Import: add_import(id, symbol); break;
    case SymbolKind::Object:
      if (const Kind* kind = find_kind(node.head())) text_.add(kind->doc);
      break;
    default: break;
  }
  text_.add(view_.index().documentation(id));
  if (id.file != file_) {
    text_.add(fmt::format("Declared in {}.", as_code(view_.file(id.file).name())));
  }
}

void Description::add_type(SymbolId id) {
  const TypeInfo* type = lang::type_of(view_.index(), id);
  if (type != nullptr) text_.add(fmt::format("Type: {}", as_code(type->name)));
}

void Description::add_loop(SymbolId id, const Symbol& symbol) {
  const auto list = ast::Node(view_.tree(id.file), symbol.owner).child(1);
  if (!list || id.file != file_) return;
  const ComputedValue value = values_.of_expression(file_, *list);
  if (value.status == ComputedValue::Status::Known) {
    text_.add("Loop variable. " + describe_value(value, values_, {}));
  } else {
    text_.add("Loop variable.");
  }
}

void Description::add_table(const Table& table) {
  constexpr std::size_t kMaxColumns = 30;
  text_.add(fmt::format("Data file: {}, {} {}.", as_code(table.file()), table.row_count(),
                        table.row_count() == 1 ? "row" : "rows"));
  std::string columns;
  for (const Column& column : table.columns()) {
    const auto index = static_cast<std::size_t>(&column - table.columns().data());
    if (index == kMaxColumns) {
      columns += fmt::format("\n* … ({} columns)", table.columns().size());
      break;
    }
    columns += fmt::format("{}* {}: {}", index == 0 ? "" : "\n",
                           as_code(column.name.empty() ? fmt::format("[{}]", index) : column.name),
                           column.has_numbers() ? "number" : "string");
  }
  text_.add(columns);
}

void Description::add_import(SymbolId id, const Symbol& symbol) {
  if (const auto table = table_of(view_, id)) return add_table(*table);
  const auto& imports = view_.module(file_).imports;
  const auto found = imports.find(symbol.name);
  if (found == imports.end() || found->second.module == kNothing) {
    text_.add("The file could not be read.");
    return;
  }
  const std::uint32_t module = found->second.module;
  text_.add(fmt::format("File: {}", as_code(view_.module(module).path.generic_string())));
  text_.add(documentation_of_file(view_.tree(module)));
}

// Symbols of the language

void Description::add_builtin(const BuiltinSymbol& builtin) {
  switch (builtin.kind) {
    case SymbolKind::BuiltinFunction: return add_function(builtin);
    case SymbolKind::BuiltinKind: return add_kind(*find_kind(builtin.name));
    case SymbolKind::Property: return add_property(*builtin.property);
    case SymbolKind::Word:
      text_.add(
          fmt::format("{}: {}", as_code(builtin.property->name), describe(*builtin.property)));
      text_.add(builtin.doc);
      return;
    case SymbolKind::BuiltinValue: {
      text_.add_code(builtin.name);
      text_.add(builtin.doc);
      const ast::Node inner = cursor_.nodes.back();
      if (inner.is(SyntaxKind::Reference)) add_value(inner);
      return;
    }
    default: text_.add_code(builtin.name); text_.add(builtin.doc);
  }
}

void Description::add_function(const BuiltinSymbol& builtin) {
  if (const Constructor* constructor = find_constructor(builtin.name)) {
    text_.add_code(signature_of(*constructor));
    text_.add(builtin.doc);
    text_.add(describe_parameters(constructor->parameters));
  } else if (const Builtin* function = find_builtin(builtin.name)) {
    text_.add_code(function->signature);
    text_.add(builtin.doc);
    if (!function->options.empty()) text_.add(describe_parameters(function->options));
  }
  add_value_of_call();
}

void Description::add_kind(const Kind& kind) {
  text_.add_code(fmt::format("{}{} {{ … }}", kind.name, kind.takes_name ? " name" : ""));
  text_.add(kind.doc);
  text_.add(fmt::format("Properties: {}", join_names(kind.properties)));
}

void Description::add_property(const Property& property) {
  const std::string_view owner = owner_of(cursor_);
  const std::string of = owner.empty() ? std::string() : fmt::format(" of {}", as_code(owner));
  text_.add(fmt::format("{}{}: {}", as_code(property.name), of, describe(property)));
  text_.add(property.doc);
  const auto labeled = labeled_at(cursor_);
  const auto value = labeled ? ast::Labeled{*labeled}.value() : std::nullopt;
  if (value) add_value(*value, &property);
}

}  // namespace

void describe_symbol(SceneView& view, std::uint32_t file, const Cursor& cursor, SymbolId symbol,
                     Values& values, HoverText& text) {
  Description(view, file, cursor, values, text).add(symbol);
}

}  // namespace sdlc::lang
