#pragma once

#include <cstdint>
#include <string_view>

#include "lang/code/code.hpp"
#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"

/// Symbols: the meanings of names.
namespace sdlc::lang {

enum class SymbolKind : std::uint8_t {
  // Declared by a file
  Let,
  Param,
  Import,
  Fn,
  Def,
  Parameter,
  LoopVariable,
  Object,  ///< the label of an object: `sphere ball { … }`
  // Defined by the language
  BuiltinValue,
  BuiltinFunction,
  BuiltinKind,
  Type,
  Property,  ///< of a built-in kind, or a parameter of a built-in function
  Word,      ///< one of a property's words
};

/// Names in different spaces do not hide each other.
enum class NameSpace : std::uint8_t {
  Values,
  Functions,
  Kinds,
  Types,
  Members,  ///< of imported files
  Labels,   ///< of properties, arguments and objects
  Words,
};

/// Identifies a symbol of a program by its file and the node that declares it: a statement, a
/// Parameter, an Object or the Name of a loop. Valid for the program whose modules it indexes.
struct SymbolId {
  static constexpr std::uint32_t kBuiltinFile = 0xFFFFFFFE;

  std::uint32_t file = kNothing;  ///< the module; kBuiltinFile; kNothing: an unknown name
  std::uint32_t index = 0;        ///< the node; of a built-in: its index in builtin_symbols()

  bool is_known() const noexcept { return file != kNothing; }
  bool is_builtin() const noexcept { return file == kBuiltinFile; }
  friend bool operator==(const SymbolId&, const SymbolId&) = default;
};

/// A symbol that a file declares.
struct Symbol {
  SymbolKind kind = SymbolKind::Let;
  bool is_local = false;      ///< in a block or a value: any but a parameter
  bool is_duplicate = false;  ///< the scope already has a declaration of the name
  NodeIndex node = 0;         ///< the declaration
  NodeIndex owner = 0;        ///< of a parameter: the fn or def; of a loop variable: the loop
  std::string_view name;
  Span where = {};             ///< the name in the declaration
  Span scope = {};             ///< where it is visible; empty for objects and duplicates
  NodeIndex hides = kNothing;  ///< of a local: the outer declaration that it hides
};

/// A name in the text.
struct Occurrence {
  Span where;
  SymbolId symbol;
};

/// A name without a meaning.
struct UnknownName {
  Span where;
  NameSpace space = NameSpace::Values;
  SymbolId owner = {};  ///< of Labels: the fn or def that has no such parameter
};

NameSpace name_space_of(SymbolKind kind) noexcept;
/// The kind's name in messages: "value", "function".
std::string_view describe(SymbolKind kind) noexcept;

}  // namespace sdlc::lang
