#include "lang/resolve/builtin_symbols.hpp"

#include <algorithm>
#include <functional>
#include <tuple>
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
  const auto is_same = [](const BuiltinSymbol& a, const BuiltinSymbol& b) {
    return !comes_before(a, b) && !comes_before(b, a);
  };
  all.erase(std::unique(all.begin(), all.end(), is_same), all.end());
  return all;
}

}  // namespace

std::span<const BuiltinSymbol> builtin_symbols() {
  static const std::vector<BuiltinSymbol> all = make_builtin_symbols();
  return all;
}

SymbolId find_builtin_symbol(SymbolKind kind, std::string_view name, const Property* property) {
  const auto all = builtin_symbols();
  const BuiltinSymbol wanted{kind, name, property};
  const auto found = std::ranges::lower_bound(all, wanted, comes_before);
  if (found == all.end() || comes_before(wanted, *found)) return {};
  return {SymbolId::kBuiltinFile, static_cast<std::uint32_t>(found - all.begin())};
}

}  // namespace sdlc::lang
