#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "lang/source/source.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/token/token.hpp"

namespace sdlc::lang {

/// A parameter, loop variable or `let` of a block.
struct LocalName {
  std::string_view name;
  Span where;
  std::string_view type = {};  ///< as declared; may be empty
  bool is_parameter = false;
};

/// What comes next in a statement or in the list inside brackets.
enum class PlaceStep : std::uint8_t {
  Start,            ///< of a statement, argument, parameter or element
  Path,             ///< after a path that begins a statement: `sphere`
  PathDot,          ///< after the dot of such a path
  ObjectName,       ///< after the name of an object
  DeclaredName,     ///< after `let`, `param`, `fn`, `def`, `for`
  AfterName,        ///< after the declared name
  AfterLabel,       ///< after the name of a property or argument, before its colon
  Type,             ///< after the colon of a param or parameter
  AfterType,        ///< after that
  AfterParameters,  ///< after the `)` of parameters
  File,             ///< after `import` or `include`
  AfterFile,        ///< after the string of an import
  ImportName,       ///< after `as`
  Operand,          ///< a value, or the operand after an operator
  AfterOperand,     ///< an operator, or the next statement
  Dot,              ///< after a dot in an expression
  Done,             ///< nothing: after `scene`
};

/// The part of `if … then … else …` that is being written.
enum class ConditionalPart : std::uint8_t { Condition, Then, Else };

/// A bracket that is open at the cursor with the statement, argument or element around the cursor;
/// or the file itself.
struct OpenBracket {
  enum class Role : std::uint8_t {
    File,
    Block,        ///< of an object, for, if, else or def
    Arguments,    ///< of a call
    Parameters,   ///< of a fn or def; the names of a loop that are in parentheses
    Parenthesis,  ///< a group or triple
    List,
    Index,
  };

  Role role = Role::File;
  Span head = {};               ///< the kind or keyword of a Block, the callee of Arguments
  std::uint32_t at = 0;         ///< where the bracket is
  std::uint32_t indent = 0;     ///< of its line
  std::uint32_t commas = 0;     ///< before the cursor
  bool has_statements = false;  ///< a Block has had statements that are no properties
  std::vector<std::string_view> labels = {};  ///< before the cursor
  std::vector<LocalName> locals = {};  ///< in the order of the text; of a List, those of its loops

  // The statement, argument or element around the cursor
  PlaceStep step = PlaceStep::Start;
  std::uint32_t begin = 0;                         ///< its first byte
  std::string_view previous = {};                  ///< the keyword of the statement before
  std::string_view word = {};                      ///< the keyword of a statement or clause
  std::string_view name = {};                      ///< that it declares
  std::string_view type = {};                      ///< of a param
  std::string_view label = {};                     ///< of a property or argument
  Span path = {};                                  ///< the last path; empty after other operands
  std::vector<LocalName> declared = {};            ///< parameters and names of a loop
  std::vector<ConditionalPart> conditionals = {};  ///< the open ones, outermost first

  bool is_block() const noexcept { return role == Role::File || role == Role::Block; }
};

/// What the cursor is in, by the tokens before it: the tree of a half-typed statement can differ
/// from what its author has in mind.
struct CursorPlace {
  enum class Kind : std::uint8_t {
    Nothing,    ///< a new name, or the inside of a string
    Comment,    ///< `token`
    FileName,   ///< of an import or include: inside the string `token`
    Color,      ///< after `#`: `token`
    Number,     ///< inside or at the end of the number `token`
    Statement,  ///< the beginning of a statement or property
    Argument,   ///< the beginning of an argument: a name or a value
    Expression,
    Operator,  ///< after an operand, where no statement can begin
    Member,    ///< after a dot; `path` is what the member is of
    Type,
    In,  ///< after the variable of a for
    As,  ///< after the file of an import
    ImportName,
  };

  Kind kind = Kind::Nothing;
  std::uint32_t offset = 0;                ///< of the cursor
  Span word = {};                          ///< the name that the cursor is in or after; or empty
  Span token = {};                         ///< for some kinds
  std::string_view before = {};            ///< the token before the word, no trivia
  bool is_first_of_line = false;           ///< only space is before the word
  bool is_first_of_statement = true;       ///< of a Member: it belongs to a kind
  std::vector<OpenBracket> brackets = {};  ///< the file, then the outermost

  const OpenBracket& inner() const noexcept { return brackets.back(); }
  /// The text of the word up to the cursor.
  std::string_view prefix(std::string_view text) const noexcept {
    return text.substr(word.begin, offset - word.begin);
  }
};

/// Whether the cursor is inside the token, or at its end where it could continue.
bool is_cursor_in(const Token& token, std::uint32_t offset);

/// Reads the tokens from the beginning of the top-level statement around the cursor. An offset past
/// the end is at the end.
CursorPlace find_cursor_place(const SyntaxTree& tree, std::uint32_t offset);

/// The labels in the bracket at the cursor that follow the cursor.
std::vector<std::string_view> labels_after(const CursorPlace& place, std::string_view text);

/// The locals that are visible at the cursor, inner scopes first. `depth`: number of scopes
/// between.
struct VisibleLocal {
  LocalName local;
  std::uint32_t depth = 0;
};
std::vector<VisibleLocal> visible_locals(const CursorPlace& place);

}  // namespace sdlc::lang
