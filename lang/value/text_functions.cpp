#include <string>

#include "lang/object/value.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

Value evaluate_str(const BuiltinCall& call) {
  if (const auto* text = argument<std::string>(call, 0)) return *text;
  const Value& value = call.arguments[0];
  const bool has_text = holds_alternative<bool>(value) || holds_alternative<Scalar>(value) ||
                        holds_alternative<Angle>(value) || holds_alternative<Triple>(value) ||
                        holds_alternative<AngleTriple>(value) ||
                        holds_alternative<render::LinearRgb>(value);
  if (has_text) return to_text(value);
  return wrong_argument(call, 0, "a number, angle, point, colour, string, true or false");
}

constexpr auto kTextFunctions = std::to_array<Builtin>({
    {"str", "str(x)", 1, 1, evaluate_str, "", "string", "lists",
     "The shortest text that reads back as the same value; a string is unchanged.", 35},
});

}  // namespace

std::span<const Builtin> text_functions() noexcept { return kTextFunctions; }

}  // namespace sdlc::lang
