#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/resolve/symbol.hpp"
#include "lang/resolve/symbol_table.hpp"

namespace sdlc::lang {

/// Collects the declarations and names that a Resolver finds in one file. Names must be views into
/// the text of the file, which gives their places.
class SymbolRecorder {
 public:
  SymbolRecorder(const SyntaxTree& tree, std::uint32_t file, SymbolDetail detail)
      : tree_(tree), file_(file), wants_all_(detail == SymbolDetail::All) {}

  // Declarations, in the order of the text

  void declare(const Symbol& symbol);
  /// A local in this slot.
  void declare_local(const Symbol& symbol, std::uint32_t slot);
  /// The declaration of the visible local in this slot.
  NodeIndex local(std::uint32_t slot) const noexcept { return locals_[slot]; }
  /// The name of an object, if it has one.
  void declare_object(ast::Object object);

  // Names, in the order of the text

  void use(std::string_view name, SymbolId symbol) { uses_.push_back({place(name), symbol}); }
  void use_own(std::string_view name, NodeIndex declaration) { use(name, {file_, declaration}); }
  void use_local(std::string_view name, std::uint32_t slot) { use_own(name, locals_[slot]); }
  void use_builtin(std::string_view name, SymbolKind kind, const Property* property = nullptr);
  /// A word as the value of a property.
  void use_word(std::string_view word, const Property& property);
  void use_unknown(std::string_view name, NameSpace space, SymbolId owner = {});

  Span place(std::string_view name) const noexcept;
  SymbolTable finish();

 private:
  void find_labels();

  const SyntaxTree& tree_;
  std::uint32_t file_;
  bool wants_all_;
  std::vector<NodeIndex> locals_;  // by slot
  std::vector<Symbol> symbols_;
  std::vector<Occurrence> uses_;
  /// A use of the name of an object of this kind, which may be declared later.
  struct Label {
    std::size_t use;
    std::string_view kind;
  };
  std::vector<Label> labels_;
  std::vector<UnknownName> unknown_;
};

}  // namespace sdlc::lang
