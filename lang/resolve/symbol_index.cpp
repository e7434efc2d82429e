#include "lang/resolve/symbol_index.hpp"

#include <algorithm>

#include "lang/repair/vocabulary.hpp"
#include "lang/resolve/builtin_symbols.hpp"
#include "lang/resolve/record_symbols.hpp"
#include "lang/schema/schema.hpp"
#include "lang/token/name_characters.hpp"

namespace sdlc::lang {
namespace {

bool is_name(std::string_view text) {
  return !text.empty() && end_of_identifier(text, 0) == text.size() &&
         !is_one_of(text, kReservedWords);
}

bool overlap(Span a, Span b) { return a.begin < b.end && b.begin < a.end; }

bool is_group_property(std::string_view name) {
  const auto properties = kind_info(ObjectKind::Group).properties;
  return std::ranges::find(properties, name, &Property::name) != properties.end();
}

/// Whether the occurrence would refer to the symbol if it had the same name.
bool is_captured(const Occurrence& occurrence, const Symbol& symbol) {
  if (!overlap(occurrence.where, symbol.scope)) return false;
  if (!occurrence.symbol.is_builtin()) return !occurrence.symbol.is_known();
  const SymbolKind kind = builtin_symbols()[occurrence.symbol.index].kind;
  return name_space_of(kind) == name_space_of(symbol.kind);
}

}  // namespace

SymbolIndex::SymbolIndex(Modules& modules, DiagnosticSink& sink) : modules_(modules) {
  modules.load_all(sink);
  for (std::uint32_t file = 0; file < modules.module_count(); ++file) {
    tables_.push_back(record_symbols(modules, file, SymbolDetail::All, sink.stop_request()));
  }
}

SymbolId SymbolIndex::at(std::uint32_t file, std::uint32_t offset) const {
  const Occurrence* found = tables_[file].at(offset);
  return found == nullptr ? SymbolId() : found->symbol;
}

const Symbol* SymbolIndex::find(SymbolId id) const {
  return id.file < tables_.size() ? tables_[id.file].find(id.index) : nullptr;
}

std::vector<FileSpan> SymbolIndex::references(SymbolId id) const {
  std::vector<FileSpan> places;
  if (!id.is_known()) return places;
  for (const SymbolTable& table : tables_) {
    for (const Occurrence& occurrence : table.occurrences()) {
      if (occurrence.symbol == id) places.push_back({table.file(), occurrence.where});
    }
  }
  return places;
}

std::vector<SymbolId> SymbolIndex::members(SymbolId import) const {
  const Symbol* symbol = find(import);
  if (symbol == nullptr || symbol->kind != SymbolKind::Import) return {};
  const auto& imports = modules_.module_at(import.file).imports;
  const auto known = imports.find(symbol->name);
  if (known == imports.end() || known->second.module >= tables_.size()) return {};
  const SymbolTable& table = tables_[known->second.module];
  std::vector<SymbolId> members;
  for (const Symbol& member : table.symbols()) {
    const bool is_member = member.kind == SymbolKind::Let || member.kind == SymbolKind::Param ||
                           member.kind == SymbolKind::Fn || member.kind == SymbolKind::Def;
    if (is_member && !member.is_local && !member.is_duplicate) {
      members.push_back(table.id_of(member));
    }
  }
  return members;
}

std::string SymbolIndex::documentation(SymbolId id) const {
  if (id.is_builtin()) return std::string(builtin_symbols()[id.index].doc);
  const Symbol* symbol = find(id);
  return symbol == nullptr ? std::string() : tables_[id.file].documentation_of(*symbol);
}

Rename SymbolIndex::rename(SymbolId id, std::string_view new_name) const {
  const Symbol* symbol = find(id);
  if (symbol == nullptr) return {.refusal = Rename::Refusal::NotDeclared};
  if (!is_name(new_name)) return {.refusal = Rename::Refusal::InvalidName};
  const SymbolTable& table = tables_[id.file];
  const bool is_def_parameter =
      symbol->kind == SymbolKind::Parameter && table.find(symbol->owner)->kind == SymbolKind::Def;
  if (is_def_parameter && is_group_property(new_name))
    return {.refusal = Rename::Refusal::Conflict};
  if (const auto conflict = find_conflict(id, new_name)) {
    return {.refusal = Rename::Refusal::Conflict, .conflict = conflict};
  }
  return {.places = references(id)};
}

/// A symbol with the new name whose scope overlaps that of `id`, or a use of the new name that
/// would then refer to `id`. Other files use only members of this file, whose conflicts are in this
/// file.
std::optional<FileSpan> SymbolIndex::find_conflict(SymbolId id, std::string_view new_name) const {
  const SymbolTable& table = tables_[id.file];
  const Symbol& symbol = *table.find(id.index);
  const NameSpace space = name_space_of(symbol.kind);
  const bool is_label = symbol.kind == SymbolKind::Object;
  for (const Symbol& other : table.symbols()) {
    const bool is_same = other.name == new_name && name_space_of(other.kind) == space;
    if (is_same && other.node != symbol.node && (is_label || overlap(other.scope, symbol.scope))) {
      return FileSpan{id.file, other.where};
    }
  }
  for (const Occurrence& occurrence : table.occurrences()) {
    const bool is_new_name = table.tree().text(occurrence.where) == new_name;
    if (is_new_name && is_captured(occurrence, symbol)) {
      return FileSpan{id.file, occurrence.where};
    }
  }
  return std::nullopt;
}

}  // namespace sdlc::lang
