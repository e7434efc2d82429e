#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

/// Which bracket is missing or one too many in a text whose brackets do not match, told by how the
/// text is laid out: what is indented belongs into the block in front of it, a bracket that stands
/// at the beginning of a line closes one of a line that is indented as much.
namespace sdlc::lang {

enum class LayoutKind : std::uint8_t {
  Open,
  Close,
  Comma,
  Label,      ///< a name with the colon behind it
  Statement,  ///< the first word of what can stand in no parenthesis
  Value,      ///< any other word or literal
  Operator,
};

/// A token as far as brackets and lines matter. Whoever makes the tokens of a language knows what
/// goes before what.
struct LayoutToken {
  std::uint32_t begin = 0, end = 0;  ///< bytes of the text
  std::uint32_t line = 0;
  std::uint32_t indent = 0;  ///< of its line
  LayoutKind kind = LayoutKind::Value;
  char bracket = '\0';     ///< of Open and Close
  bool is_first = false;   ///< of its line
  bool continues = false;  ///< belongs to what the line before began
  bool is_call = false;    ///< Open: it holds arguments; Operator: it stands behind their labels
  bool is_head = false;    ///< Open: it holds parameters, behind which a definition follows
  bool defines = false;    ///< what parameters are for stands behind: `=` or a block
  bool is_stray = false;   ///< Open: nothing in front of it opens a block; Comma: no block has it
  /// The bracket that ought to stand in front of this token, and does not.
  char wanted = '\0';
  /// A value begins here, whose bracket may be missing.
  bool may_open = false;
  bool is_callable = false;     ///< a name in the place of a value
  bool is_apart = false;        ///< nothing stands between it and the value in front of it
  std::string_view meant = {};  ///< the word that this one is a misspelling of; empty: none
};

/// What is wrong with the brackets, or between them, at one place.
struct BracketFault {
  enum Kind : std::uint8_t {
    MissingOpen,   ///< in front of `token`
    MissingClose,  ///< likewise
    Surplus,       ///< `token` itself
    Swapped,       ///< `token` and the next
    MissingMark,   ///< a comma or colon in front of `token`
    MissingThird,  ///< the third of a triple, whose end `token` is
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  Kind kind;
  char bracket;                   ///< what is missing, or what is too much
  std::uint32_t token;            ///< the number of tokens: the end of the text
  std::uint32_t partner = kNone;  ///< the other bracket of the pair, where the text has it
};

struct BracketRepair {
  std::vector<BracketFault> faults;      ///< by their places
  std::vector<std::uint32_t> uncertain;  ///< tokens that close a pair in a value with a fault
};

/// Where blocks in braces may stand.
enum class BlockPlace : std::uint8_t {
  Statements,  ///< in other blocks, never inside parentheses
  Values,      ///< wherever a value may: those of JSON
};

/// The likeliest explanation, or none where nothing is wrong, too much is, or the nesting is too
/// deep (kMaxNesting). The time grows with the number of tokens alone, the memory not at all.
BracketRepair repair_brackets(std::span<const LayoutToken> tokens,
                              BlockPlace blocks = BlockPlace::Statements);

}  // namespace sdlc::lang
