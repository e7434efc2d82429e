#include "lang/resolve/builtin_symbols.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <tuple>
#include <unordered_map>
#include <vector>

#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/types.hpp"

namespace sdlc::lang {
namespace {

bool comes_before(const BuiltinSymbol& a, const BuiltinSymbol& b) {
  if (a.kind != b.kind) return a.kind < b.kind;
  if (a.property != b.property) return std::less<>()(a.property, b.property);
  return a.name < b.name;
}

struct IsSame {
  bool operator()(const BuiltinSymbol& a, const BuiltinSymbol& b) const noexcept {
    return a.kind == b.kind && a.property == b.property && a.name == b.name;
  }
};

void add_properties(std::vector<BuiltinSymbol>& all, std::span<const Property> properties) {
  for (const Property& property : properties) {
    all.push_back({SymbolKind::Property, property.name, &property, property.doc});
    for (const std::string_view word : property.words) {
      all.push_back({SymbolKind::Word, word, &property, property.doc});
    }
    if (property.reads_none) all.push_back({SymbolKind::Word, "none", &property, property.doc});
  }
}

std::vector<BuiltinSymbol> make_builtin_symbols() {
  std::vector<BuiltinSymbol> all{
      {SymbolKind::BuiltinValue, "pi", nullptr, "Half a turn in radians: 3.14159…"},
      {SymbolKind::BuiltinValue, "time", nullptr, "The time of the frame, in seconds."}};
  for (const NamedColor& color : named_colors()) {
    all.push_back({SymbolKind::BuiltinValue, color.name, nullptr, "A colour of CSS."});
  }
  for (const Builtin& builtin : all_builtins()) {
    all.push_back({SymbolKind::BuiltinFunction, builtin.name, nullptr, builtin.doc});
    add_properties(all, builtin.options);
  }
  for (const Constructor& constructor : all_constructors()) {
    all.push_back({SymbolKind::BuiltinFunction, constructor.name, nullptr, constructor.doc});
    add_properties(all, constructor.parameters);
  }
  for (const Kind& kind : all_kinds()) {
    all.push_back({SymbolKind::BuiltinKind, kind.name, nullptr, kind.doc});
    add_properties(all, kind.properties);
  }
  for (const TypeInfo& type : all_types()) {
    all.push_back({SymbolKind::Type, type.name, nullptr, type.doc});
  }
  std::ranges::sort(all, comes_before);
  // Constructors may share a table of parameters.
  all.erase(std::unique(all.begin(), all.end(), IsSame()), all.end());
  return all;
}

struct Hash {
  std::size_t operator()(const BuiltinSymbol& symbol) const noexcept {
    if (symbol.property != nullptr) return std::hash<const void*>()(symbol.property);
    return std::hash<std::string_view>()(symbol.name);
  }
};

using IndexOfBuiltins = std::unordered_map<BuiltinSymbol, std::uint32_t, Hash, IsSame>;

/// Every use of a built-in name is looked up after each key in an editor.
IndexOfBuiltins make_index(std::span<const BuiltinSymbol> all) {
  IndexOfBuiltins index_of;
  for (std::uint32_t i = 0; i < all.size(); ++i) index_of.emplace(all[i], i);
  return index_of;
}

}  // namespace

std::span<const BuiltinSymbol> builtin_symbols() {
  static const std::vector<BuiltinSymbol> all = make_builtin_symbols();
  return all;
}

SymbolId find_builtin_symbol(SymbolKind kind, std::string_view name, const Property* property) {
  static const IndexOfBuiltins index_of = make_index(builtin_symbols());
  const auto found = index_of.find({kind, name, property});
  if (found == index_of.end()) return {};
  return {SymbolId::kBuiltinFile, found->second};
}

}  // namespace sdlc::lang
