#pragma once

#include <cstdint>
#include <ostream>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"

/// What editors color: the tokens of a scene with what each of them is. Every source of colors (a
/// query of tree-sitter, a TextMate grammar, semantic tokens) maps its own names to these classes,
/// and is compared with `classify()`.
namespace sdlc::test {

enum class TokenClass : std::uint8_t {
  Comment,
  DocComment,
  String,
  Number,
  Color,
  Boolean,
  Keyword,
  Operator,
  Punctuation,      ///< brackets, commas, colons and points
  Property,         ///< the label of a property
  Parameter,        ///< of a function or kind, and the label of an argument
  Label,            ///< the name of an object
  Variable,         ///< a let, param or loop variable: declared or used
  BuiltinValue,     ///< `pi`, `time`, or a color of CSS
  Member,           ///< a name after a point in a value
  Module,           ///< an imported file: declared, or before the point of a kind or function
  Function,         ///< declared or called
  BuiltinFunction,  ///< constructors too
  Type,             ///< a kind of a `def`: declared or used; an unknown type
  BuiltinType,      ///< a kind or type of the language
  Wrong,            ///< not part of a correct text
};

std::string_view name_of(TokenClass token_class) noexcept;
inline void PrintTo(TokenClass token_class, std::ostream* out) { *out << name_of(token_class); }

struct ClassifiedToken {
  lang::Span span;
  TokenClass token_class = TokenClass::Wrong;

  friend bool operator==(const ClassifiedToken&, const ClassifiedToken&) = default;
};

/// All tokens of the text without its space, by the lexer and the syntax tree of the program. Names
/// are those of the language wherever they could be: declarations that hide them do not count.
std::vector<ClassifiedToken> classify(const lang::SourceFile& file);

/// The differences, one per line with its position; empty if there are none.
std::string compare_tokens(const lang::SourceFile& file,
                           const std::vector<ClassifiedToken>& expected,
                           const std::vector<ClassifiedToken>& actual);

}  // namespace sdlc::test
