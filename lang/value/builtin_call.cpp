#include "lang/value/builtin_call.hpp"

#include "lang/value/arithmetic.hpp"

namespace sdlc::lang {

Value wrong_argument(const BuiltinCall& call, std::size_t i, std::string_view wanted) {
  const Location where = call.place(i);
  auto report =
      call.sink.report(diag::wrong_argument, where, call.name, wanted, describe(call.arguments[i]));
  const bool is_literal = call.node.child(i)->is(SyntaxKind::Number);
  if (wanted == kAngleWanted && is_literal && holds_alternative<Scalar>(call.arguments[i])) {
    report.unsafe_fix({where.file, {where.span.end, where.span.end}}, "deg");
  } else if (wanted == kAngleWanted && holds_alternative<Scalar>(call.arguments[i])) {
    report.help("multiply a number by `1deg` to get an angle: `x * 1deg`");
  }
  return Nothing{};
}

Value no_result(const BuiltinCall& call, std::string_view argument) {
  call.sink.report(diag::no_real_result, call.where(), call.name, argument);
  return Nothing{};
}

Value finite(const BuiltinCall& call, Value result) {
  if (is_finite(result)) return result;
  call.sink.report(diag::overflow, call.where(), call.name);
  return Nothing{};
}

}  // namespace sdlc::lang
