#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "lang/syntax/syntax.hpp"

/// The code that the evaluator runs: expressions and statements with resolved names, in flat arrays
/// that refer to each other by index.
namespace sdlc::lang {

inline constexpr std::uint32_t kNothing = 0xFFFFFFFF;

/// Operation of an expression. Its operands are in Code::operands, most are indices of expressions.
enum class Op : std::uint8_t {
  Broken,       ///< operands, evaluated to report their errors; the value is Nothing
  Number,       ///< `first`: index in Code::numbers; `detail`: its Unit
  Constant,     ///< `first`: index in Code::constants
  Time,         ///< `time`
  Local,        ///< `first`: slot of the frame
  Global,       ///< operands: module, global
  Negative,     ///< operand
  Not,          ///< operand
  Sum,          ///< operands; all but the first have their operator in `before`
  Product,      ///< the same
  Power,        ///< base, exponent
  And,          ///< operands
  Or,           ///< operands
  Comparison,   ///< left, right; the operator is right's `before`
  Interval,     ///< from, to
  Triple,       ///< three
  List,         ///< elements
  Conditional,  ///< condition, value, …, value
  Member,       ///< operand; `detail`: 'x', 'y' or 'z'; 0: an unknown member
  Index,        ///< list, position
  Function,     ///< module, function, then per parameter an argument or kNothing
  Builtin,      ///< index in all_builtins(), arguments
  Constructor,  ///< index in all_constructors(), then per parameter an argument or kNothing
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
  Let,       ///< slot, expression
  For,       ///< slot, list, block
  If,        ///< [condition or kNothing, block]...
  Assert,    ///< condition, message
  Object,    ///< [property or kNothing, expression]...; its kind is Statement::kind
  Group,     ///< number of lets, lets that properties may use; number of properties, [property or
             ///< kNothing, expression]...; block, which contains the lets too
  Instance,  ///< module, def, number of group properties, [property, expression]..., then an
             ///< argument or kNothing per parameter
  Include,   ///< module, or index of a config plus kConfigs
};

struct Statement {
  Action action = Action::Let;
  ObjectKind kind = ObjectKind::Sphere;
  NodeIndex node = 0;
  std::uint32_t first = 0;  ///< operand
  std::uint32_t count = 0;  ///< of operands
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
  }
};

}  // namespace sdlc::lang
