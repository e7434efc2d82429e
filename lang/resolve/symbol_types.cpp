#include "lang/resolve/symbol_types.hpp"

#include <algorithm>
#include <optional>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/ast/statements.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/data_format.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/constructors.hpp"

namespace sdlc::lang {
namespace {

using Name = std::string_view;  // of a type; empty: unknown

class TypeInference {
 public:
  explicit TypeInference(const SymbolIndex& index) : index_(index) {}

  Name of_symbol(SymbolId id) {
    if (id.is_builtin()) return of_builtin(builtin_symbols()[id.index]);
    const Symbol* symbol = index_.find(id);
    if (symbol == nullptr || is_exhausted()) return {};
    const ast::Node node(index_.table(id.file).tree(), symbol->node);
    switch (symbol->kind) {
      case SymbolKind::Let:
      case SymbolKind::Param:
      case SymbolKind::Parameter:
      case SymbolKind::Fn: {
        if (const auto type = node.first(SyntaxKind::TypeName)) return type->text();
        const auto value = ast::expression_of(node);
        return value ? of_expression(id.file, *value) : Name();
      }
      case SymbolKind::Import: {
        const auto path = node.first(SyntaxKind::String);
        if (!path) return {};
        const Name text = path->text();
        const bool is_data = text.size() > 1 && data_format_of(text.substr(1, text.size() - 2));
        return is_data ? "list" : Name();
      }
      case SymbolKind::LoopVariable: {
        return of_loop_variable(id.file, *symbol);
      }
      default: return {};
    }
  }

  /// The type of the elements of a list that a let declares.
  Name of_elements(SymbolId id) {
    const Symbol* symbol = index_.find(id);
    if (symbol == nullptr || symbol->kind != SymbolKind::Let) return {};
    const auto value = ast::expression_of(ast::Node(index_.table(id.file).tree(), symbol->node));
    return value ? of_element(id.file, *value) : Name();
  }

 private:
  /// Nothing is known of parts: a list has one type of elements, a row several.
  Name of_loop_variable(std::uint32_t file, const Symbol& symbol) {
    const ast::Node loop(index_.table(file).tree(), symbol.owner);
    const ast::LoopNames names = ast::names_of_loop(loop);
    if (names.has_index && names.all[0].index() == symbol.node) return "number";
    const auto list = loop.child(1);
    return list && !names.takes_apart ? of_element(file, *list) : Name();
  }

  /// References may be long chains, and cyclic in files with errors.
  bool is_exhausted() {
    constexpr int kMaxSteps = 1000, kMaxDepth = 100;
    return ++steps_ > kMaxSteps || depth_ > kMaxDepth;
  }

  static Name of_builtin(const BuiltinSymbol& builtin) {
    if (builtin.kind != SymbolKind::BuiltinValue) return {};
    return builtin.name == "pi" || builtin.name == "time" ? "number" : "color";
  }

  Name of_expression(std::uint32_t file, ast::Node node) {
    if (is_exhausted()) return {};
    ++depth_;
    const Name type = of_operation(file, node);
    --depth_;
    return type;
  }

  Name of_child(std::uint32_t file, ast::Node node, std::size_t n) {
    const auto child = node.child(n);
    return child ? of_expression(file, *child) : Name();
  }

  Name of_operation(std::uint32_t file, ast::Node node) {
    switch (node.kind()) {
      case SyntaxKind::Number: {
        const Name text = node.text();
        const bool is_angle =
            text.ends_with("deg") || text.ends_with("rad") || text.ends_with("turn");
        return is_angle ? "angle" : "number";
      }
      case SyntaxKind::String: return "string";
      case SyntaxKind::Color: return "color";
      case SyntaxKind::True:
      case SyntaxKind::False:
      case SyntaxKind::Not:
      case SyntaxKind::And:
      case SyntaxKind::Or:
      case SyntaxKind::Comparison: return "bool";
      case SyntaxKind::Interval: return "interval";
      case SyntaxKind::List:
      case SyntaxKind::Comprehension: return "list";
      case SyntaxKind::Triple: return of_child(file, node, 0) == "angle" ? "angles" : "vec3";
      case SyntaxKind::Power: return "number";
      case SyntaxKind::Group:
      case SyntaxKind::Negative: return of_child(file, node, 0);
      case SyntaxKind::Sum: return of_sum(file, node);
      case SyntaxKind::Postfix: return of_postfix(file, node);
      case SyntaxKind::Conditional: return of_child(file, node, 1);
      case SyntaxKind::LetIn: {
        Name type;
        for (const ast::Node part : node.children()) {
          if (!part.is(SyntaxKind::Binding)) type = of_expression(file, part);
        }
        return type;
      }
      case SyntaxKind::Product: return of_product(file, node);
      case SyntaxKind::Call: return of_call(file, node);
      case SyntaxKind::Reference: return of_reference(file, node);
      default: return {};
    }
  }

  /// All summands have one type.
  Name of_sum(std::uint32_t file, ast::Node node) {
    for (const ast::Node summand : node.children()) {
      const Name type = of_expression(file, summand);
      if (!type.empty()) return type;
    }
    return {};
  }

  /// A product has the type of the factor that is no number; a quotient of two angles is a number.
  Name of_product(std::uint32_t file, ast::Node node) {
    Name type = "number";
    bool is_known = true;
    for (const ast::Node factor : node.children()) {
      const Name next = of_expression(file, factor);
      if (type == "angle" && next == "angle" && factor.op() == Operator::Divide) {
        type = "number";
      } else if (type == "number" && !next.empty()) {
        type = next;
      }
      is_known = is_known && (!next.empty() || (type != "number" && type != "angle"));
    }
    return is_known ? type : Name();
  }

  /// An element of a list that is declared with its elements, or a component.
  Name of_postfix(std::uint32_t file, ast::Node node) {
    const auto operand = node.child(0), postfix = node.child(1);
    if (!operand || !postfix || node.child(2)) return {};
    if (postfix->is(SyntaxKind::Index)) {
      return of_child(file, *postfix, 0) == "list" ? "list" : of_element(file, *operand);
    }
    return of_component(of_expression(file, *operand));
  }

  static Name of_component(Name type) {
    return type == "vec3" ? "number" : type == "angles" ? "angle" : Name();
  }

  Name of_call(std::uint32_t file, ast::Node node) {
    const Occurrence* callee = last_name(file, node.head_span());
    if (callee == nullptr) return {};
    if (!callee->symbol.is_builtin()) return of_symbol(callee->symbol);
    const Name result = result_of_builtin(builtin_symbols()[callee->symbol.index].name);
    return result == "=" ? of_child(file, node, 0) : result;
  }

  /// Components of vectors are numbers, those of three angles are angles.
  Name of_reference(std::uint32_t file, ast::Node node) {
    const Occurrence* name = last_name(file, node.span());
    if (name == nullptr) return {};
    const Name type = of_symbol(name->symbol);
    if (name->where.end == node.span().end) return type;
    return of_component(type);
  }

  Name of_element(std::uint32_t file, ast::Node list) {
    if (is_exhausted()) return {};
    if (list.is(SyntaxKind::List)) return of_all(file, list);
    if (list.is(SyntaxKind::Comprehension)) return of_child(file, list, 0);
    if (list.is(SyntaxKind::Call)) return of_element_of_call(file, list);
    if (!list.is(SyntaxKind::Reference)) return {};
    const Occurrence* name = last_name(file, list.span());
    if (name == nullptr || name->where.end != list.span().end) return {};
    return of_elements(name->symbol);
  }

  Name of_element_of_call(std::uint32_t file, ast::Node call) {
    if (call.head() == "range") return of_child(file, call, 0);
    const auto list = call.child(0);
    const bool keeps_elements = call.head() == "sort" || call.head() == "reverse";
    return keeps_elements && list ? of_element(file, *list) : Name();
  }

  /// The type of the children if they have one.
  Name of_all(std::uint32_t file, ast::Node node) {
    Name type;
    for (const ast::Node child : node.children()) {
      const Name next = of_expression(file, child);
      if (next.empty() || (!type.empty() && next != type)) return {};
      type = next;
    }
    return type;
  }

  /// The last name in a path that has a symbol; components may follow it.
  const Occurrence* last_name(std::uint32_t file, Span path) const {
    const auto names = index_.table(file).occurrences();
    auto found = std::ranges::upper_bound(names, path.end, {},
                                          [](const Occurrence& o) { return o.where.end; });
    if (found == names.begin() || (--found)->where.begin < path.begin) return nullptr;
    return &*found;
  }

  const SymbolIndex& index_;
  int steps_ = 0, depth_ = 0;
};

}  // namespace

std::string_view result_of_builtin(std::string_view function) {
  if (const Builtin* builtin = find_builtin(function)) return builtin->result;
  const Constructor* constructor = find_constructor(function);
  return constructor == nullptr ? std::string_view() : result_of(*constructor);
}

const TypeInfo* type_of(const SymbolIndex& index, SymbolId symbol) {
  const Name name = TypeInference(index).of_symbol(symbol);
  return name.empty() ? nullptr : find_type(name);
}

const TypeInfo* element_type_of(const SymbolIndex& index, SymbolId list) {
  const Name name = TypeInference(index).of_elements(list);
  return name.empty() ? nullptr : find_type(name);
}

}  // namespace sdlc::lang
