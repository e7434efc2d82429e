#include <charconv>
#include <string>

#include <fmt/format.h>

#include "lang/object/value.hpp"

namespace sdlc::lang {

std::string to_text(double number) {
  if (number == 0) return "0";  // -0 too
  char buffer[32];
  const auto result = std::to_chars(std::begin(buffer), std::end(buffer), number);
  std::string text(buffer, result.ptr);

  // 1e+10 becomes 1e10, and 1e-07 becomes 1e-7.
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;
  std::size_t digits = e + 1;
  if (text[digits] == '+') {
    text.erase(digits, 1);
  } else if (text[digits] == '-') {
    ++digits;
  }
  text.erase(digits, text.find_first_not_of('0', digits) - digits);
  return text;
}

std::string_view suffix_of(Unit unit) noexcept {
  return unit == Unit::Length ? "m" : unit == Unit::Time ? "s" : "";
}

namespace {

std::string to_text(render::Vec3 v) {
  return fmt::format("({}, {}, {})", lang::to_text(v.x), lang::to_text(v.y), lang::to_text(v.z));
}

std::string to_text(render::LinearRgb c) {
  return fmt::format("linear({}, {}, {})", lang::to_text(c.r), lang::to_text(c.g),
                     lang::to_text(c.b));
}

std::string to_text(double from, double to) {
  return fmt::format("{} .. {}", lang::to_text(from), lang::to_text(to));
}

std::string string_literal(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (c == '\n') {
      result += "\\n";
    } else if (c == '\t') {
      result += "\\t";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result += '"';
}

std::string to_text(const MaterialValue& material) {
  const MaterialInfo& info = material_info(material.kind);
  std::string text = fmt::format("{}(color: {}", info.name, to_text(material.color));
  for (const Property& argument : info.arguments) {
    if (argument.type == Type::Number) {
      text += fmt::format(", {}: {}", argument.name, lang::to_text(material.parameter));
    } else if (argument.type == Type::Word && material.exact_fresnel) {
      text += fmt::format(", {}: exact", argument.name);
    }
  }
  return text += ')';
}

struct Writer {
  std::string operator()(Nothing) const { return "nothing"; }
  std::string operator()(Scalar scalar) const {
    return fmt::format("{}{}", lang::to_text(scalar.value), suffix_of(scalar.unit));
  }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(const std::string& text) const { return string_literal(text); }
  std::string operator()(const Triple& triple) const { return to_text(triple.value); }
  std::string operator()(Angle angle) const { return lang::to_text(angle.degrees) + "deg"; }
  std::string operator()(const AngleTriple& angles) const {
    const auto [x, y, z] = angles.degrees;
    return fmt::format("({}deg, {}deg, {}deg)", lang::to_text(x), lang::to_text(y),
                       lang::to_text(z));
  }
  std::string operator()(const Bounds& bounds) const { return to_text(bounds.from, bounds.to); }
  std::string operator()(const Word& word) const { return word.text; }
  std::string operator()(None) const { return "none"; }
  std::string operator()(const ListValue&) const { return "[…]"; }  // may have any length
  std::string operator()(const RowValue&) const { return "[…]"; }
  std::string operator()(const MotionValue& motion) const {
    return fmt::format("line(to: {}, over: {})", to_text(motion.to),
                       to_text(motion.over.from, motion.over.to));
  }
  template <typename T>
  std::string operator()(const T& value) const {
    return to_text(value);
  }
};

struct Describer {
  std::string_view operator()(Nothing) const { return "nothing"; }
  std::string_view operator()(Scalar scalar) const {
    switch (scalar.unit) {
      case Unit::None: return "a number";
      case Unit::Length: return "a length";
      case Unit::Time: return "a time";
    }
    return "";
  }
  std::string_view operator()(bool) const { return "true or false"; }
  std::string_view operator()(const std::string&) const { return "a string"; }
  std::string_view operator()(const Triple& triple) const {
    return triple.unit == Unit::Time ? "three times" : "a point (x, y, z)";
  }
  std::string_view operator()(Angle) const { return "an angle"; }
  std::string_view operator()(const AngleTriple&) const { return "three angles"; }
  std::string_view operator()(render::LinearRgb) const { return "a colour"; }
  std::string_view operator()(const Bounds& bounds) const {
    return bounds.unit == Unit::Length ? "an interval of lengths" : "an interval a .. b";
  }
  std::string_view operator()(const MaterialValue&) const { return "a material"; }
  std::string_view operator()(const MotionValue&) const { return "a motion"; }
  std::string_view operator()(const Word&) const { return "a word"; }
  std::string_view operator()(None) const { return "`none`"; }
  std::string_view operator()(const ListValue&) const { return "a list"; }
  std::string_view operator()(const RowValue&) const { return "a row"; }
};

}  // namespace

std::string to_text(const Value& value) { return visit(Writer{}, value); }

std::string_view describe(const Value& value) noexcept { return visit(Describer{}, value); }

}  // namespace sdlc::lang
