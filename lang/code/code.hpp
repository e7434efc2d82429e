#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string_view>
#include <vector>

#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "lang/syntax/syntax.hpp"

/// The code that the evaluator runs: expressions and statements with resolved names, in flat arrays
/// that refer to each other by index.
namespace sdlc::lang {

inline constexpr std::uint32_t kNothing = 0xFFFFFFFF;

/// The names of a loop as operands: consecutive slots of the index, if there is one, and of the
/// element or its parts.
struct LoopSlots {
  static constexpr std::size_t kOperands = 3;

  std::uint32_t slot;  ///< the first
  bool has_index;
  std::uint32_t part_count;  ///< 0: the element is not destructured

  explicit LoopSlots(std::span<const std::uint32_t> operands)
      : slot(operands[0]), has_index(operands[1] != 0), part_count(operands[2]) {}

  std::uint32_t element_slot() const noexcept { return slot + has_index; }
  std::uint32_t size() const noexcept { return has_index + std::max(part_count, 1u); }
};

/// Operation of an expression. Its operands are in Code::operands, most are indices of expressions.
enum class Op : std::uint8_t {
  Broken,         ///< operands, evaluated to report their errors; the value is Nothing
  Number,         ///< `first`: index in Code::numbers; `detail`: its Unit
  Constant,       ///< `first`: index in Code::constants
  Time,           ///< `time`
  Local,          ///< `first`: slot of the frame
  Outer,          ///< `first`: slot of a frame around; `detail`: how many further out it is
  Global,         ///< operands: module, global
  Negative,       ///< operand
  Not,            ///< operand
  Sum,            ///< operands; all but the first have their operator in `before`
  Product,        ///< the same
  Power,          ///< base, exponent
  And,            ///< operands
  Or,             ///< operands
  Comparison,     ///< left, right; the operator is right's `before`
  Interval,       ///< from, to
  Triple,         ///< three
  List,           ///< elements
  Comprehension,  ///< value, clauses
  ForClause,      ///< LoopSlots, list
  IfClause,       ///< condition
  Conditional,    ///< condition, value, …, value
  LetIn,          ///< the first slot of its locals, their values, the value
  Member,         ///< operand, index of the name in Code::names; `detail`: 'x', 'y', 'z', or 0
  Index,          ///< list, position
  Function,       ///< module, function, then per parameter an argument or kNothing
  LocalFunction,  ///< how many frames further out it is declared, index in Code::definitions, then
                  ///< per parameter an argument or kNothing
  Builtin,        ///< index in all_builtins(), arguments
  Constructor,    ///< index in all_constructors(), then per parameter an argument or kNothing
};

struct Expression {
  Op op = Op::Broken;
  Operator before = Operator::None;  ///< before an operand of a chain
  std::uint8_t detail = 0;
  NodeIndex node = 0;       ///< where errors of the value are reported
  std::uint32_t first = 0;  ///< operand
  std::uint32_t count = 0;  ///< of operands
};
static_assert(sizeof(Expression) == 16);

/// Action of a statement, with its operands. A block is its number of statements, then these.
enum class Action : std::uint8_t {
  Let,     ///< slot, expression
  For,     ///< LoopSlots, list, block
  If,      ///< [condition or kNothing, block]...
  Assert,  ///< condition, message
  Object,  ///< [property or kNothing, expression]...; its kind is Statement::kind
  Group,   ///< number of lets, lets that properties may use; number of properties, [property or
           ///< kNothing, expression]...; block, which contains the lets too
  LocalInstance,  ///< as Instance, but first how many frames further out the def is declared, index
                  ///< in Code::definitions
  Instance,       ///< module, def, number of group properties, [property, expression]..., then an
                  ///< argument or kNothing per parameter
  Include,        ///< module, or index of a config plus kConfigs
};

struct Statement {
  Action action = Action::Let;
  ObjectKind kind = ObjectKind::Sphere;
  NodeIndex node = 0;
  std::uint32_t first = 0;  ///< operand
  std::uint32_t count = 0;  ///< of operands
};

struct TypeInfo;

struct Parameter {
  std::string_view name;
  NodeIndex node = 0;
  bool has_default = false;
  const TypeInfo* type = nullptr;
  std::uint32_t default_value = kNothing;  ///< expression, which may use the parameters before it
};

/// A local of a frame around that of a definition.
struct OuterLocal {
  std::uint32_t frame = 0;  ///< the number of frames around that one
  std::uint32_t slot = 0;
  friend bool operator==(const OuterLocal&, const OuterLocal&) = default;
};

/// A fn or def. Its parameters are the first slots of its frame.
struct Definition {
  std::string_view name;
  NodeIndex node = 0;        ///< the statement
  std::uint32_t module = 0;  ///< the file
  std::vector<Parameter> parameters;
  std::uint32_t frame_size = 0;
  std::uint32_t body = kNothing;     ///< of a fn: expression
  std::vector<std::uint32_t> block;  ///< of a def: statements
  bool uses_time = false;            ///< of a fn of the top level: may read `time`
  bool is_broken = false;            ///< parameters may be missing because of an error

  // Of a local definition
  std::uint32_t index = 0;        ///< in Code::definitions
  std::uint32_t frame = 0;        ///< the number of frames around its own
  std::vector<OuterLocal> outer;  ///< what it reads, itself or through others
  bool reads_more_outer = false;  ///< `outer` is not complete
  bool is_open = false;           ///< it is being resolved
};

/// The code of a file's declarations, or of one other statement of its top level.
struct Code {
  explicit Code(const SyntaxTree& tree_) : tree(&tree_) {}

  const SyntaxTree* tree;
  std::vector<Expression> expressions;
  std::vector<Statement> statements;
  std::vector<std::uint32_t> operands;
  std::vector<double> numbers;
  std::vector<Value> constants;
  std::vector<std::string_view> names;  ///< of members, in the text
  std::deque<Definition> definitions;   ///< fns and defs in blocks
  std::uint32_t frame_size = 0;         ///< slots of a statement or expression outside definitions

  std::span<const std::uint32_t> operands_of(const Expression& e) const noexcept {
    return std::span(operands).subspan(e.first, e.count);
  }
  std::span<const std::uint32_t> operands_of(const Statement& s) const noexcept {
    return std::span(operands).subspan(s.first, s.count);
  }
  void clear() {
    expressions.clear();
    statements.clear();
    operands.clear();
    numbers.clear();
    constants.clear();
    names.clear();
    definitions.clear();
    frame_size = 0;
  }
};

}  // namespace sdlc::lang
