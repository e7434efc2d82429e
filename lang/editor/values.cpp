#include "lang/editor/values.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <utility>

#include "lang/ast/statements.hpp"
#include "lang/editor/cursor.hpp"

namespace sdlc::lang {
namespace {

std::span<const Occurrence> names_in(const SymbolTable& table, Span span) {
  const auto names = table.occurrences();
  const auto begin = [](const Occurrence& name) { return name.where.begin; };
  return {std::ranges::lower_bound(names, span.begin, {}, begin),
          std::ranges::lower_bound(names, span.end, {}, begin)};
}

bool has_errors(ast::Node node) {
  const auto nodes = node.tree().nodes().subspan(node.index());
  return std::ranges::any_of(nodes.first(nodes[0].extent),
                             [](const SyntaxNode& part) { return part.kind == SyntaxKind::Error; });
}

bool contains(Span outer, Span inner) {
  return outer.begin <= inner.begin && inner.end <= outer.end;
}

ComputedValue computed(ProbedValue probed) {
  using enum ComputedValue::Status;
  if (probed.is_too_expensive) return {.status = TooExpensive};
  if (is_nothing(probed.value)) return {.status = Wrong};
  return {.status = Known, .value = std::move(probed.value), .reads_time = probed.reads_time};
}

}  // namespace

const Symbol* local_at(const SymbolTable& table, const Occurrence& name) {
  if (name.symbol.file != table.file()) return nullptr;
  const Symbol* symbol = table.find(name.symbol.index);
  if (symbol == nullptr) return nullptr;
  const bool is_local = symbol->is_local || symbol->kind == SymbolKind::Parameter ||
                        symbol->kind == SymbolKind::LoopVariable;
  const bool is_label = has_colon_after(table.tree().file().text(), name.where.end);
  return is_local && !is_label ? symbol : nullptr;
}

ComputedValue Values::of_expression(std::uint32_t file, ast::Node expression,
                                    const Property* property) {
  constexpr std::uint32_t kMaxNodes = 20'000;
  if (expression.tree()[expression.index()].extent > kMaxNodes) {
    return {.status = ComputedValue::Status::TooExpensive};
  }
  if (has_errors(expression)) return {};
  const SymbolTable& table = view_.table(file);
  for (const Occurrence& name : names_in(table, expression.span())) {
    if (!name.symbol.is_known()) return {};
    const Symbol* local = local_at(table, name);
    if (local != nullptr && !contains(expression.span(), local->where)) {
      return {.status = ComputedValue::Status::Local, .local = local->name};
    }
  }
  return computed(probe_.expression(file, expression, property));
}

ComputedValue Values::of_symbol(SymbolId id) {
  const Symbol* symbol = view_.index().find(id);
  const bool has_value = symbol != nullptr &&
                         (symbol->kind == SymbolKind::Let || symbol->kind == SymbolKind::Param) &&
                         !symbol->is_duplicate;
  if (!has_value) return {};
  if (symbol->is_local) {
    const auto value = ast::expression_of({view_.tree(id.file), symbol->node});
    return value ? of_expression(id.file, *value) : ComputedValue{};
  }
  const Module& module = view_.module(id.file);
  const auto found = module.global_names.find(symbol->name);
  if (found == module.global_names.end()) return {};
  return computed(probe_.global(id.file, found->second));
}

}  // namespace sdlc::lang
