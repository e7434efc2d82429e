#pragma once

#include <cstdint>

namespace sdlc::lang {

/// What a committed rule expects, as far as its error message depends on it.
enum class Wanted : std::uint8_t {
  Other,
  Name,           ///< of a declaration
  LabeledValue,   ///< after `name:`
  Is,             ///< `=` and the definition
  FunctionIs,     ///< the same after the parameters of an `fn`
  Type,           ///< of a parameter
  In,             ///< of a `for`
  Block,          ///< in braces
  LoopBlock,      ///< the same of a `for`
  Then,           ///< of an `if` that is a value
  LetIn,          ///< `in` of a `let` that is a value
  Message,        ///< of an assertion
  FileName,       ///< of an import
  ParametersEnd,  ///< `,` or `)`
  ArgumentsEnd,   ///< `,` or `)`
  GroupEnd,       ///< `)` after a value or the third of a point
  ListEnd,        ///< `,` or `]`
  ClausesEnd,     ///< `]` after the clauses of a list
  IndexEnd,       ///< `]`
  SecondName,     ///< `,` and another name: one alone is not destructured
  PatternEnd,     ///< `,` or `)` of the names in a `for`
  SecondOperand,  ///< none: comparisons make no chain
};

struct Expectation {
  const char* words = nullptr;  ///< for "expected …"
  Wanted wanted = Wanted::Other;
};

}  // namespace sdlc::lang
