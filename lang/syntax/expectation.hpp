#pragma once

#include <cstdint>

namespace sdlc::lang {

/// What kind of thing a committed rule wants, as far as it matters to whoever tells that it is not
/// there.
enum class Wanted : std::uint8_t {
  Other,
  Name,           ///< of what is declared
  LabeledValue,   ///< behind `name:`
  Is,             ///< `=` and what it defines
  FunctionIs,     ///< likewise, behind the parameters of an `fn`
  Type,           ///< of a parameter
  In,             ///< of a `for`
  Block,          ///< in braces
  Then,           ///< of an `if` that is a value
  Message,        ///< of an assertion
  FileName,       ///< of an import
  ParametersEnd,  ///< `,` or `)`
  ArgumentsEnd,   ///< `,` or `)`
  GroupEnd,       ///< `)` behind a value or the third of a point
  ListEnd,        ///< `,` or `]`
  IndexEnd,       ///< `]`
  SecondOperand,  ///< none: comparisons make no chain
};

struct Expectation {
  const char* words = nullptr;  ///< what a user is told to have been expected
  Wanted wanted = Wanted::Other;
};

}  // namespace sdlc::lang
