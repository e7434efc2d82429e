#include "lang/resolve/misspellings.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

/// The time of the search is proportional to their product. Larger texts are not written by hand.
constexpr std::size_t kMaxSymbols = 10'000, kMaxUnknown = 500;

/// Counts the words of a text; `golden_angle` is two words.
class Words {
 public:
  explicit Words(std::string_view text) {
    for_each_word(text, [&](std::string word) { ++counts_[std::move(word)]; });
  }

  /// Whether all words of the name occur more often than in the `own_uses` uses of the name.
  bool knows(std::string_view name, std::uint32_t own_uses) const {
    bool is_known = true, is_word = false;
    for_each_word(name, [&](const std::string& word) {
      const auto found = counts_.find(word);
      is_word = is_word || word.size() >= kMinLetters;
      is_known = is_known && found != counts_.end() && found->second > own_uses;
    });
    return is_known && is_word;
  }

 private:
  static constexpr std::size_t kMinLetters = 3;

  template <typename Function>
  static void for_each_word(std::string_view text, Function function) {
    std::string word;
    for (const char c : text) {
      if (is_ascii_letter(c)) {
        word += to_lower(c);
      } else if (!word.empty()) {
        function(std::exchange(word, {}));
      }
    }
    if (!word.empty()) function(std::move(word));
  }

  std::map<std::string, std::uint32_t> counts_;
};

/// Finds the most similar declaration of an unknown name.
class DeclarationSearch {
 public:
  DeclarationSearch(const SymbolTable& table, const StopRequest* stop)
      : table_(table), uses_(table.count_uses(true, stop)) {}

  /// The most similar declaration if nothing uses it, else null.
  const Symbol* nearest(const UnknownName& unknown) const {
    const std::string_view name = table_.tree().text(unknown.where);
    std::vector<const Symbol*> symbols = candidates(unknown);
    // nearest_name() prefers the first of equally near ones: unused, then at the top level.
    std::ranges::stable_sort(symbols, {}, [&](const Symbol* symbol) {
      return std::tuple(is_used(*symbol), symbol->is_local, symbol->node);
    });
    std::vector<std::string_view> names;
    for (const Symbol* symbol : symbols) names.push_back(symbol->name);
    const auto found = nearest_name(name, names);
    constexpr std::size_t kMaxLengthDifference = 2;
    const bool is_near = found && found->size() <= name.size() + kMaxLengthDifference &&
                         name.size() <= found->size() + kMaxLengthDifference;
    if (!is_near) return nullptr;
    const Symbol* symbol =
        symbols[static_cast<std::size_t>(std::ranges::find(names, *found) - names.begin())];
    return is_used(*symbol) ? nullptr : symbol;
  }

 private:
  bool is_used(const Symbol& symbol) const {
    return uses_[static_cast<std::size_t>(&symbol - table_.symbols().data())] > 0;
  }

  std::vector<const Symbol*> candidates(const UnknownName& unknown) const {
    std::vector<const Symbol*> symbols;
    if (unknown.space == NameSpace::Labels) {
      if (unknown.owner.file != table_.file()) return {};
      for (const Symbol& symbol : table_.symbols()) {
        const bool is_parameter = symbol.kind == SymbolKind::Parameter;
        if (is_parameter && symbol.owner == unknown.owner.index) symbols.push_back(&symbol);
      }
      return symbols;
    }
    symbols = table_.visible(unknown.where.begin, unknown.space);
    // A value cannot use itself.
    std::erase_if(symbols, [&](const Symbol* symbol) {
      const Span own = table_.tree()[symbol->node].span();
      const bool is_inside = own.begin <= unknown.where.begin && unknown.where.end <= own.end;
      return is_inside && (symbol->kind == SymbolKind::Let || symbol->kind == SymbolKind::Param);
    });
    return symbols;
  }

  const SymbolTable& table_;
  std::vector<std::uint32_t> uses_;
};

bool may_be_declared(NameSpace space) {
  return space == NameSpace::Values || space == NameSpace::Functions || space == NameSpace::Kinds ||
         space == NameSpace::Labels;
}

}  // namespace

Misspellings::Misspellings(const SymbolTable& table, const StopRequest* stop) {
  if (table.symbols().size() > kMaxSymbols) return;
  const DeclarationSearch search(table, stop);
  std::map<std::pair<const Symbol*, std::string_view>, std::vector<Span>> groups;
  std::size_t searched = 0;
  for (const UnknownName& unknown : table.unknown()) {
    stop_if_requested(stop);
    if (!may_be_declared(unknown.space)) continue;
    if (++searched > kMaxUnknown) break;
    const Symbol* symbol = search.nearest(unknown);
    if (symbol != nullptr)
      groups[{symbol, table.tree().text(unknown.where)}].push_back(unknown.where);
  }
  if (groups.empty()) return;
  const Words words(table.tree().file().text());
  for (const auto& [key, uses] : groups) {
    const auto& [symbol, meant] = key;
    const bool is_certain =
        uses.size() > 1 || (words.knows(meant, 1) && !words.knows(symbol->name, 1));
    for (const Span use : uses) {
      uses_[use.begin] = {.declared = table.tree().location(symbol->where),
                          .used = table.tree().location(uses.front()),
                          .name = symbol->name,
                          .meant = meant,
                          .is_certain = is_certain};
    }
  }
}

const Misspelling* Misspellings::find(std::uint32_t use) const {
  const auto found = uses_.find(use);
  return found == uses_.end() ? nullptr : &found->second;
}

}  // namespace sdlc::lang
