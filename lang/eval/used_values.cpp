#include "lang/eval/used_values.hpp"

#include <span>

namespace sdlc::lang {
namespace {

constexpr std::size_t kMaxExpressions = 100'000;  // about a millisecond

/// The operands that are expressions; the first ones may be indices of something else.
std::span<const std::uint32_t> expressions_in(const Code& code, const Expression& e) {
  switch (e.op) {
    case Op::Number:
    case Op::Constant:
    case Op::Time:
    case Op::Local:
    case Op::Outer:
    case Op::Global: return {};
    case Op::Function:
    case Op::LocalFunction: return code.operands_of(e).subspan(2);
    case Op::LetIn:
    case Op::Builtin:
    case Op::Constructor: return code.operands_of(e).subspan(1);
    case Op::ForClause: return code.operands_of(e).subspan(LoopSlots::kOperands);
    default: return code.operands_of(e);
  }
}

}  // namespace

bool UsedValues::add(const Code& code, std::uint32_t expression) {
  open_.push_back({&code, expression});
  return visit_all();
}

bool UsedValues::add_global(std::uint32_t module, std::uint32_t global) {
  visit_global(module, global);
  return visit_all();
}

bool UsedValues::visit_all() {
  bool is_good = true;
  while (is_good && !open_.empty()) {
    const Part part = open_.back();
    open_.pop_back();
    is_good = ++visited_ <= kMaxExpressions && visit(part);
  }
  return is_good;
}

bool UsedValues::visit(const Part& part) {
  const Expression& e = part.code->expressions[part.expression];
  switch (e.op) {
    case Op::Time: uses_time_ = true; break;
    case Op::Global: {
      const auto operands = part.code->operands_of(e);
      visit_global(operands[0], operands[1]);
      break;
    }
    case Op::Function: {
      const auto operands = part.code->operands_of(e);
      visit_function(operands[0], operands[1]);
      break;
    }
    default: break;
  }
  for (const std::uint32_t operand : expressions_in(*part.code, e)) {
    if (operand != kNothing) open_.push_back({part.code, operand});
  }
  return true;
}

void UsedValues::visit_global(std::uint32_t module, std::uint32_t global) {
  if (known_.contains(module, global) || found_.contains(module, global)) return;
  found_.add(module, global);
  globals_.push_back({module, global});
  const Module& file = program_.module(module);
  const std::uint32_t value = file.globals[global].value;
  if (value != kNothing) open_.push_back({&file.code, value});
}

void UsedValues::visit_function(std::uint32_t module, std::uint32_t function) {
  if (!functions_.emplace(module, function).second) return;
  const Module& file = program_.module(module);
  const Definition& definition = file.functions[function];
  if (definition.body != kNothing) open_.push_back({&file.code, definition.body});
  for (const Parameter& parameter : definition.parameters) {
    const std::uint32_t value = parameter.default_value;
    if (value != kNothing) open_.push_back({&file.code, value});
  }
}

}  // namespace sdlc::lang
