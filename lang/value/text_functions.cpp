#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "lang/object/value.hpp"
#include "lang/text/utf8.hpp"
#include "lang/value/builtin_call.hpp"
#include "lang/value/builtin_tables.hpp"

namespace sdlc::lang {
namespace {

enum : std::size_t { kDigits, kWidth, kFill };

constexpr auto kStrOptions = std::to_array<Property>({
    {.name = "digits",
     .type = Type::WholeNumber,
     .range = Range::UpToHundred,
     .doc =
         "Of numbers and angles: so many digits after the point, rounded to the nearest, and "
         "of two equally near to the even one (`round` rounds halves away from 0); without it, as "
         "few as are necessary."},
    {.name = "width",
     .type = Type::WholeNumber,
     .range = Range::UpToHundred,
     .default_text = "0",
     .doc = "At least so many characters; shorter texts are filled on the left."},
    {.name = "fill",
     .type = Type::String,
     .default_text = "\" \"",
     .doc = "The character to fill with; `\"0\"` goes after a minus."},
});

/// As printf writes it: the exact binary value is rounded, halves to even. Zero has no sign.
std::string fixed(double number, int digits) {
  constexpr std::size_t kMaxBeforePoint = 312, kMaxDigits = 100;
  std::array<char, kMaxBeforePoint + kMaxDigits> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number,
                                    std::chars_format::fixed, digits);
  std::string text(buffer.data(), result.ptr);
  const bool is_zero = text.find_first_not_of("-0.") == std::string::npos;
  if (is_zero && text.starts_with('-')) text.erase(0, 1);
  return text;
}

/// The number with so many digits after the point, and its unit; else Nothing, which is reported.
Value fixed_text(const BuiltinCall& call, int digits) {
  const Value& value = call.arguments[0];
  if (const auto* angle = get_if<Angle>(&value)) return fixed(angle->degrees, digits) + "deg";
  if (const auto* number = get_if<Scalar>(&value)) {
    return fixed(number->value, digits) + std::string(suffix_of(number->unit));
  }
  return wrong_argument(call, 0, "a number or an angle with `digits`");
}

Value shortest_text(const BuiltinCall& call) {
  if (const auto* text = argument<std::string>(call, 0)) return *text;
  const Value& value = call.arguments[0];
  const bool has_text = holds_alternative<bool>(value) || holds_alternative<Scalar>(value) ||
                        holds_alternative<Angle>(value) || holds_alternative<Triple>(value) ||
                        holds_alternative<AngleTriple>(value) ||
                        holds_alternative<render::LinearRgb>(value);
  if (has_text) return to_text(value);
  return wrong_argument(call, 0, "a number, angle, point, colour, string, true or false");
}

/// The text, filled on the left to the width in characters.
std::string padded(std::string text, std::size_t width, std::string_view fill) {
  const std::size_t length = count_code_points(text);
  std::string padding;
  for (std::size_t i = length; i < width; ++i) padding += fill;
  return text.insert(fill == "0" && text.starts_with('-') ? 1 : 0, padding);
}

Value evaluate_str(const BuiltinCall& call) {
  const auto* digits = get_if<Scalar>(&call.options[kDigits]);
  const auto* width = get_if<Scalar>(&call.options[kWidth]);
  const auto* fill = get_if<std::string>(&call.options[kFill]);
  if (fill != nullptr && count_code_points(*fill) != 1) {
    call.sink.report(diag::wrong_argument, call.option_node(kFill)->location(), "str",
                     "one character to fill with", to_text(call.options[kFill]));
    return Nothing{};
  }
  Value value =
      digits != nullptr ? fixed_text(call, static_cast<int>(digits->value)) : shortest_text(call);
  const auto* text = get_if<std::string>(&value);
  if (text == nullptr || width == nullptr) return value;
  return padded(*text, static_cast<std::size_t>(width->value), fill != nullptr ? *fill : " ");
}

constexpr auto kTextFunctions = std::to_array<Builtin>({
    {.name = "str",
     .signature = "str(x, digits: …, width: 0, fill: \" \")",
     .min_arguments = 1,
     .max_arguments = 1,
     .evaluate = evaluate_str,
     .takes = "",
     .result = "string",
     .topic = "lists",
     .doc = "The shortest text that reads back as the same value; a string is unchanged.",
     .steps = 35,
     .options = kStrOptions},
});

}  // namespace

std::span<const Builtin> text_functions() noexcept { return kTextFunctions; }

}  // namespace sdlc::lang
