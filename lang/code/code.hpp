#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "lang/syntax/syntax.hpp"

/// Expressions and statements with resolved names: what the evaluator runs. The code is flat; its
/// parts refer to each other by index.
namespace sdlc::lang {

inline constexpr std::uint32_t kNothing = 0xFFFFFFFF;

/// What an expression does. `operands` are entries of Code::operands, most of them expressions.
enum class Op : std::uint8_t {
  Broken,       ///< operands: evaluated for their errors only; the result has failed
  Number,       ///< first: in Code::numbers; `detail` is the Unit
  Constant,     ///< first: in Code::constants
  Time,         ///< `time`
  Local,        ///< first: slot of the frame
  Global,       ///< operands: module, global
  Negative,     ///< operand
  Not,          ///< operand
  Sum,          ///< operands; each but the first has its operator in `before`
  Product,      ///< likewise
  Power,        ///< base, exponent
  And,          ///< operands
  Or,           ///< operands
  Comparison,   ///< left, right; the operator is right's `before`
  Interval,     ///< from, to
  Triple,       ///< three
  List,         ///< elements
  Conditional,  ///< condition, value, …, value
  Member,       ///< operand; `detail` is 'x', 'y' or 'z', or 0 for what no value has
  Index,        ///< list, position
  Function,     ///< module, function, then an argument or kNothing a parameter
  Builtin,      ///< index in all_builtins(), arguments
  Constructor,  ///< index in all_constructors(), then an argument or kNothing a parameter
};

struct Expression {
  Op op = Op::Broken;
  Operator before = Operator::None;  ///< before an operand of a chain
  std::uint8_t detail = 0;
  NodeIndex node = 0;       ///< errors of the value are reported there
  std::uint32_t first = 0;  ///< of the operands
  std::uint32_t count = 0;  ///< of the operands
};
static_assert(sizeof(Expression) == 16);

/// What a statement does. A block is the number of its statements, then the statements.
enum class Action : std::uint8_t {
  Let,       ///< slot, expression
  For,       ///< slot, list, block
  If,        ///< [condition or kNothing, block]...
  Assert,    ///< condition, message
  Object,    ///< [property or kNothing, expression]... of an object of this `kind`
  Group,     ///< number of lets, lets that properties may use; number of properties, [property or
             ///< kNothing, expression]...; block, which contains the lets too
  Instance,  ///< module, def, number of group properties, [property, expression]..., then an
             ///< argument or kNothing a parameter
  Include,   ///< module, or index of a config plus kConfigs
};

struct Statement {
  Action action = Action::Let;
  ObjectKind kind = ObjectKind::Sphere;
  NodeIndex node = 0;
  std::uint32_t first = 0;  ///< of the operands
  std::uint32_t count = 0;  ///< of the operands
};

/// Code of one file, or of one statement of its top level.
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
