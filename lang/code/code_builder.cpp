#include "lang/code/code_builder.hpp"

#include <algorithm>
#include <utility>

namespace sdlc::lang {

void CodeBuilder::remove(std::size_t from, std::size_t to) {
  const auto begin = pending_.begin();
  pending_.erase(begin + static_cast<std::ptrdiff_t>(from),
                 begin + static_cast<std::ptrdiff_t>(to));
}

void CodeBuilder::remove_nothing(std::size_t from) {
  const auto begin = pending_.begin() + static_cast<std::ptrdiff_t>(from);
  pending_.erase(std::remove(begin, pending_.end(), kNothing), pending_.end());
}

std::vector<std::uint32_t> CodeBuilder::take(std::size_t from) {
  const auto begin = pending_.begin() + static_cast<std::ptrdiff_t>(from);
  std::vector<std::uint32_t> taken(begin, pending_.end());
  pending_.resize(from);
  return taken;
}

std::uint32_t CodeBuilder::move_operands(std::size_t mark) {
  const auto first = static_cast<std::uint32_t>(code_->operands.size());
  const auto begin = pending_.begin() + static_cast<std::ptrdiff_t>(mark);
  code_->operands.insert(code_->operands.end(), begin, pending_.end());
  pending_.resize(mark);
  return first;
}

std::uint32_t CodeBuilder::add(Op op, ast::Node node, std::uint32_t first, std::uint32_t count,
                               std::uint8_t detail) {
  code_->expressions.push_back({.op = op,
                                .before = Operator::None,
                                .detail = detail,
                                .node = node.index(),
                                .first = first,
                                .count = count});
  return static_cast<std::uint32_t>(code_->expressions.size() - 1);
}

std::uint32_t CodeBuilder::add_with(Op op, ast::Node node, std::size_t mark, std::uint8_t detail) {
  const auto count = static_cast<std::uint32_t>(pending_.size() - mark);
  return add(op, node, move_operands(mark), count, detail);
}

std::uint32_t CodeBuilder::add_constant(ast::Node node, Value value) {
  code_->constants.push_back(std::move(value));
  return add(Op::Constant, node, static_cast<std::uint32_t>(code_->constants.size() - 1));
}

std::uint32_t CodeBuilder::add_number(ast::Node node, Scalar number) {
  code_->numbers.push_back(number.value);
  return add(Op::Number, node, static_cast<std::uint32_t>(code_->numbers.size() - 1), 0,
             static_cast<std::uint8_t>(number.unit));
}

std::uint32_t CodeBuilder::add_member(ast::Node node, std::uint32_t operand,
                                      std::string_view name) {
  const bool is_axis = name == "x" || name == "y" || name == "z";
  const std::size_t operands = mark();
  push({operand, static_cast<std::uint32_t>(code_->names.size())});
  code_->names.push_back(name);
  return add_with(Op::Member, node, operands, is_axis ? static_cast<std::uint8_t>(name[0]) : 0);
}

std::uint32_t CodeBuilder::add_statement(Action action, ast::Node node, std::size_t mark,
                                         ObjectKind kind) {
  const auto count = static_cast<std::uint32_t>(pending_.size() - mark);
  code_->statements.push_back({.action = action,
                               .kind = kind,
                               .node = node.index(),
                               .first = move_operands(mark),
                               .count = count});
  return static_cast<std::uint32_t>(code_->statements.size() - 1);
}

}  // namespace sdlc::lang
