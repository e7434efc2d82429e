#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <vector>

#include "lang/ast/ast.hpp"
#include "lang/code/code.hpp"
#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// Appends expressions and statements to a Code. Operands are pushed onto a stack; an expression or
/// statement takes those above a mark.
class CodeBuilder {
 public:
  explicit CodeBuilder(Code& code) : code_(&code) {}

  Code& code() noexcept { return *code_; }
  void write_to(Code& code) noexcept { code_ = &code; }

  // Operands

  std::size_t mark() const noexcept { return pending_.size(); }
  void push(std::uint32_t operand) { pending_.push_back(operand); }
  void push(std::initializer_list<std::uint32_t> operands) {
    pending_.insert(pending_.end(), operands);
  }
  void push(const std::vector<std::uint32_t>& operands) {
    pending_.insert(pending_.end(), operands.begin(), operands.end());
  }
  /// The operand at this position of the stack.
  std::uint32_t& operator[](std::size_t position) noexcept { return pending_[position]; }
  /// Pushes an operand, which operator[] replaces later; returns its position.
  std::size_t reserve() {
    pending_.push_back(0);
    return pending_.size() - 1;
  }
  /// Removes the operands [from, to) of the stack.
  void remove(std::size_t from, std::size_t to);
  /// Removes the operands from `from` on that are kNothing.
  void remove_nothing(std::size_t from);
  /// Removes and returns the operands from `from` on.
  std::vector<std::uint32_t> take(std::size_t from);

  // Expressions; all return the index of the new one

  std::uint32_t add(Op op, ast::Node node, std::uint32_t first = 0, std::uint32_t count = 0,
                    std::uint8_t detail = 0);
  /// With the operands above `mark`.
  std::uint32_t add_with(Op op, ast::Node node, std::size_t mark, std::uint8_t detail = 0);
  std::uint32_t add_broken(ast::Node node) { return add(Op::Broken, node); }
  std::uint32_t add_constant(ast::Node node, Value value);
  std::uint32_t add_number(ast::Node node, Scalar number);
  /// `operand.name`, a part of the text; an unknown name is an error of the evaluation.
  std::uint32_t add_member(ast::Node node, std::uint32_t operand, std::string_view name);

  // Statements; returns the index of the new one, with the operands above `mark`

  std::uint32_t add_statement(Action action, ast::Node node, std::size_t mark,
                              ObjectKind kind = ObjectKind::Sphere);

 private:
  /// Moves the operands above `mark` to the code; returns the index of the first.
  std::uint32_t move_operands(std::size_t mark);

  Code* code_;
  std::vector<std::uint32_t> pending_;
};

}  // namespace sdlc::lang
