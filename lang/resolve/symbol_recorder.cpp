#include "lang/resolve/symbol_recorder.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "lang/resolve/builtin_symbols.hpp"

namespace sdlc::lang {

Span SymbolRecorder::place(std::string_view name) const noexcept {
  const auto begin = static_cast<std::uint32_t>(name.data() - tree_.file().text().data());
  return {begin, begin + static_cast<std::uint32_t>(name.size())};
}

void SymbolRecorder::declare(const Symbol& symbol) {
  symbols_.push_back(symbol);
  symbols_.back().where = place(symbol.name);
}

void SymbolRecorder::declare_local(const Symbol& symbol, std::uint32_t slot) {
  locals_.resize(slot);
  locals_.push_back(symbol.node);
  if (!symbol.name.empty()) declare(symbol);
}

void SymbolRecorder::declare_object(ast::Object object) {
  const auto name = object.name();
  if (!wants_all_ || !name || name->span().size() == 0) return;
  declare({.kind = SymbolKind::Object, .node = object.node.index(), .name = name->text()});
}

void SymbolRecorder::use_builtin(std::string_view name, SymbolKind kind, const Property* property) {
  const bool is_time = kind == SymbolKind::BuiltinValue && name == "time";
  if (wants_all_ || is_time) use(name, find_builtin_symbol(kind, name, property));
}

void SymbolRecorder::use_word(std::string_view word, const Property& property) {
  if (!wants_all_) return;
  const SymbolId symbol = find_builtin_symbol(SymbolKind::Word, word, &property);
  if (symbol.is_known()) return use(word, symbol);
  if (property.words.empty()) {
    const bool is_sphere = property.type == Type::Focus;
    labels_.push_back({.use = uses_.size(), .kind = is_sphere ? "sphere" : "camera"});
  }
  use_unknown(word, NameSpace::Words);
}

void SymbolRecorder::use_unknown(std::string_view name, NameSpace space, SymbolId owner) {
  if (name.empty()) return;
  uses_.push_back({place(name), {}});
  unknown_.push_back({.where = place(name), .space = space, .owner = owner});
}

void SymbolRecorder::find_labels() {
  for (const auto& [use, kind] : labels_) {
    Occurrence& occurrence = uses_[use];
    for (const Symbol& symbol : symbols_) {
      const bool is_named = symbol.kind == SymbolKind::Object &&
                            ast::Node(tree_, symbol.node).head() == kind &&
                            symbol.name == tree_.text(occurrence.where);
      if (is_named) occurrence.symbol = {file_, symbol.node};
    }
    if (!occurrence.symbol.is_known()) continue;
    std::erase_if(unknown_, [&](const UnknownName& u) { return u.where == occurrence.where; });
  }
}

SymbolTable SymbolRecorder::finish() {
  find_labels();
  const auto begin = [](const Occurrence& occurrence) { return occurrence.where.begin; };
  // The walk follows the text, except around errors.
  if (!std::ranges::is_sorted(symbols_, {}, &Symbol::node)) {
    std::ranges::stable_sort(symbols_, {}, &Symbol::node);
  }
  if (!std::ranges::is_sorted(uses_, {}, begin)) std::ranges::stable_sort(uses_, {}, begin);
  std::vector<Occurrence> declarations;
  declarations.reserve(symbols_.size());
  for (const Symbol& symbol : symbols_) {
    declarations.push_back({symbol.where, {file_, symbol.node}});
  }
  std::vector<Occurrence> all;
  all.reserve(uses_.size() + declarations.size());
  std::ranges::merge(uses_, declarations, std::back_inserter(all), {}, begin, begin);
  return {tree_, file_, std::move(symbols_), std::move(all), std::move(unknown_)};
}

}  // namespace sdlc::lang
