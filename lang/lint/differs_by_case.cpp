#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "lang/lint/context.hpp"

namespace sdlc::lang {
namespace {

std::string in_lower_case(std::string_view name) {
  std::string lower(name);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// Names of one or two letters, such as `r` and `R`, or `dt` and `dT`, are those of formulas, which
/// distinguish them.
bool is_checked(const Symbol& symbol) {
  constexpr std::size_t kMinLetters = 3;
  const NameSpace space = name_space_of(symbol.kind);
  return (space == NameSpace::Values || space == NameSpace::Functions ||
          space == NameSpace::Kinds) &&
         symbol.name.size() >= kMinLetters && !symbol.name.starts_with('_');
}

/// The checked symbols by the begin of their scopes, outer ones first.
std::vector<const Symbol*> checked_symbols(const SymbolTable& names) {
  std::vector<const Symbol*> symbols;
  for (const Symbol& symbol : names.symbols()) {
    if (is_checked(symbol)) symbols.push_back(&symbol);
  }
  std::ranges::stable_sort(symbols, {}, [](const Symbol* symbol) { return symbol->scope.begin; });
  return symbols;
}

void report(LintContext& context, const Symbol& symbol, const Symbol& other) {
  const SyntaxTree& tree = *context.tree();
  const bool is_later = symbol.where.begin > other.where.begin;
  const auto& [first, second] = is_later ? std::pair(other, symbol) : std::pair(symbol, other);
  Finding& finding = context.add(diag::differs_by_case, LintPlace::of(tree.location(second.where)),
                                 second.name, first.name);
  finding.labels.push_back({LintPlace::of(tree.location(first.where)), "declared here"});
  finding.help.push_back("rename one of them, so that a misspelt one is not taken for the other");
}

}  // namespace

/// Two values, two functions or two kinds of the file are visible together, and their names differ
/// only in the case of letters: a slip of the shift key gives the other one, without an error.
/// Names of up to two letters and those that begin with `_` are not compared.
void check_differs_by_case(LintContext& context) {
  // By name space and name: the symbols whose scopes may contain the next one. Scopes are nested,
  // so a list is never longer than they are deep.
  std::map<std::pair<NameSpace, std::string>, std::vector<const Symbol*>> visible;
  for (const Symbol* symbol : checked_symbols(context.names())) {
    context.stop_if_requested();
    auto& others = visible[{name_space_of(symbol->kind), in_lower_case(symbol->name)}];
    std::erase_if(others,
                  [&](const Symbol* other) { return other->scope.end <= symbol->scope.begin; });
    const auto other = std::ranges::find_if(
        others, [&](const Symbol* candidate) { return candidate->name != symbol->name; });
    if (other != others.end()) report(context, *symbol, **other);
    others.push_back(symbol);
  }
}

}  // namespace sdlc::lang
