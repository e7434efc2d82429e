#include "lang/resolve/symbol_table.hpp"

#include <algorithm>
#include <functional>
#include <iterator>
#include <unordered_set>

namespace sdlc::lang {

NameSpace name_space_of(SymbolKind kind) noexcept {
  switch (kind) {
    case SymbolKind::Fn:
    case SymbolKind::BuiltinFunction: return NameSpace::Functions;
    case SymbolKind::Def:
    case SymbolKind::BuiltinKind: return NameSpace::Kinds;
    case SymbolKind::Type: return NameSpace::Types;
    case SymbolKind::Property:
    case SymbolKind::Object: return NameSpace::Labels;
    case SymbolKind::Word: return NameSpace::Words;
    default: return NameSpace::Values;
  }
}

std::string_view describe(SymbolKind kind) noexcept {
  switch (kind) {
    case SymbolKind::Let:
    case SymbolKind::BuiltinValue: return "value";
    case SymbolKind::Param: return "param";
    case SymbolKind::Import: return "import";
    case SymbolKind::Fn:
    case SymbolKind::BuiltinFunction: return "function";
    case SymbolKind::Def:
    case SymbolKind::BuiltinKind: return "kind";
    case SymbolKind::Parameter: return "parameter";
    case SymbolKind::LoopVariable: return "loop variable";
    case SymbolKind::Object: return "object";
    case SymbolKind::Type: return "type";
    case SymbolKind::Property: return "property";
    case SymbolKind::Word: return "word";
  }
  return "";
}

const Symbol* SymbolTable::find(NodeIndex node) const noexcept {
  const auto found = std::ranges::lower_bound(symbols_, node, {}, &Symbol::node);
  return found != symbols_.end() && found->node == node ? &*found : nullptr;
}

const Occurrence* SymbolTable::at(std::uint32_t offset) const noexcept {
  const auto after = std::ranges::upper_bound(occurrences_, offset, {},
                                              [](const Occurrence& o) { return o.where.begin; });
  if (after == occurrences_.begin()) return nullptr;
  const Occurrence& found = *std::prev(after);
  return offset <= found.where.end ? &found : nullptr;
}

std::vector<std::uint32_t> SymbolTable::count_uses(bool counts_recursion,
                                                   const StopRequest* stop) const {
  std::vector<std::uint32_t> uses(symbols_.size());
  for (const Occurrence& occurrence : occurrences_) {
    stop_if_requested(stop);
    if (occurrence.symbol.file != file_) continue;
    const Symbol* symbol = find(occurrence.symbol.index);
    if (occurrence.where == symbol->where) continue;
    const Span own = (*tree_)[symbol->node].span();
    const bool is_definition = symbol->kind == SymbolKind::Fn || symbol->kind == SymbolKind::Def;
    const bool is_inside = own.begin <= occurrence.where.begin && occurrence.where.end <= own.end;
    if (is_definition && is_inside && !counts_recursion) continue;
    ++uses[static_cast<std::size_t>(symbol - symbols_.data())];
  }
  return uses;
}

std::vector<const Symbol*> SymbolTable::visible(std::uint32_t offset, NameSpace space) const {
  std::vector<const Symbol*> found;
  for (const Symbol& symbol : symbols_) {
    const bool has_begun = symbol.scope.begin < offset || symbol.scope.begin == 0;
    const bool is_visible = has_begun && offset <= symbol.scope.end;
    const bool is_named = symbol.kind != SymbolKind::Object && !symbol.is_duplicate;
    if (is_visible && is_named && name_space_of(symbol.kind) == space) found.push_back(&symbol);
  }
  // The scopes around a place are nested, so a scope that begins later is further in. That of the
  // top level begins at 0.
  std::ranges::stable_sort(found, std::greater<>(), [](const Symbol* s) { return s->scope.begin; });
  std::unordered_set<std::string_view> names;
  std::erase_if(found, [&](const Symbol* symbol) { return !names.insert(symbol->name).second; });
  return found;
}

std::vector<Symbol> SymbolTable::parameters_of(NodeIndex owner) const {
  std::vector<Symbol> parameters;
  NodeIndex end = owner + 1;  // of the last parameter, whose default may declare names too
  auto symbol = std::ranges::upper_bound(symbols_, owner, {}, &Symbol::node);
  for (; symbol != symbols_.end(); ++symbol) {
    if (symbol->kind == SymbolKind::Parameter && symbol->owner == owner) {
      parameters.push_back(*symbol);
      end = symbol->node + (*tree_)[symbol->node].extent;
    } else if (symbol->node >= end) {
      break;
    }
  }
  return parameters;
}

std::string SymbolTable::documentation_of(const Symbol& symbol) const {
  const std::string_view text = tree_->file().text();
  const auto comments = tree_->comments();
  std::uint32_t begin = (*tree_)[symbol.node].begin;
  const auto after = std::ranges::lower_bound(
      comments, begin, {}, [](const Comment& comment) { return comment.span.begin; });
  auto first = after;
  while (first != comments.begin() && std::prev(first)->kind == CommentKind::Doc) {
    const Span span = std::prev(first)->span;
    const std::string_view between = text.substr(span.end, begin - span.end);
    if (between.find_first_not_of(" \t\r\n") != std::string_view::npos) break;
    begin = span.begin;
    --first;
  }
  std::string documentation;
  for (auto comment = first; comment != after; ++comment) {
    std::string_view line = tree_->text(comment->span);
    line.remove_prefix(std::string_view("///").size());
    if (line.starts_with(' ')) line.remove_prefix(1);
    while (line.ends_with('\r') || line.ends_with('\n')) line.remove_suffix(1);
    if (comment != first) documentation += '\n';
    documentation += line;
  }
  return documentation;
}

}  // namespace sdlc::lang
