#include "lang/editor/value_text.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "lang/schema/schema.hpp"
#include "lang/text/utf8.hpp"
#include "lang/value/colors.hpp"
#include "render/image/tone.hpp"

namespace sdlc::lang {
namespace {

constexpr std::size_t kMaxElements = 6, kMaxBytes = 80;
constexpr int kMaxDepth = 2;  // of nested lists

bool is_displayable(render::LinearRgb color) {
  const auto is_fraction = [](double v) { return v >= 0 && v <= 1; };
  return is_fraction(color.r) && is_fraction(color.g) && is_fraction(color.b);
}

std::string text_of(render::LinearRgb color) {
  return fmt::format("linear({:.6g}, {:.6g}, {:.6g})", color.r, color.g, color.b);
}

std::string text_of(const MaterialValue& material) {
  const MaterialInfo& info = material_info(material.kind);
  const std::string color = exact_hex(material.color).value_or(text_of(material.color));
  std::string text = fmt::format("{}(color: {}", info.name, color);
  for (const Property& argument : info.arguments) {
    if (argument.type == Type::Number) {
      text += fmt::format(", {}: {}", argument.name, to_text(material.parameter));
    } else if (argument.type == Type::Word && material.exact_fresnel) {
      text += fmt::format(", {}: exact", argument.name);
    }
  }
  return text += ')';
}

std::string text_of(const std::string& text) {
  if (text.size() <= kMaxBytes) return to_text(Value(text));
  std::size_t end = kMaxBytes;
  while (end > 0 && is_continuation(text[end])) --end;
  std::string literal = to_text(Value(text.substr(0, end)));
  literal.insert(literal.size() - 1, "…");
  return fmt::format("{} ({} bytes)", literal, text.size());
}

std::string text_at_depth(const Value& value, int depth);

std::string text_of(const ListValue& list, int depth) {
  if (depth == kMaxDepth) return "[…]";
  std::string text = "[";
  const std::size_t shown = std::min(list.size(), kMaxElements);
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += ", ";
    text += text_at_depth(list[i], depth + 1);
  }
  if (shown == list.size()) return text + "]";
  return fmt::format("{}, …] ({} elements)", text, list.size());
}

std::string text_at_depth(const Value& value, int depth) {
  if (const ListValue* list = elements_of(value)) return text_of(*list, depth);
  if (const auto* text = get_if<std::string>(&value)) return text_of(*text);
  if (const auto* color = get_if<render::LinearRgb>(&value)) return text_of(*color);
  if (const auto* material = get_if<MaterialValue>(&value)) return text_of(*material);
  return to_text(value);
}

/// A number of metres or seconds in a unit of a size that suits it; empty if that is the base unit.
std::string in_other_unit(Scalar scalar) {
  const double size = std::fabs(scalar.value);
  if (size == 0 || scalar.unit == Unit::None) return {};
  if (scalar.unit == Unit::Time) {
    return size < 1 ? fmt::format("{:.6g}ms", scalar.value * 1000) : std::string();
  }
  if (size < 0.01) return fmt::format("{:.6g}mm", scalar.value * 1000);
  if (size < 1) return fmt::format("{:.6g}cm", scalar.value * 100);
  return size >= 1000 ? fmt::format("{:.6g}km", scalar.value / 1000) : std::string();
}

}  // namespace

std::string short_text(const Value& value) { return text_at_depth(value, 0); }

std::vector<std::string> other_spellings(const Value& value) {
  constexpr double kRadiansPerDegree = 0.017453292519943295;
  std::vector<std::string> others;
  if (const auto* angle = get_if<Angle>(&value)) {
    others.push_back(to_text(angle->degrees * kRadiansPerDegree) + "rad");
  } else if (const auto* scalar = get_if<Scalar>(&value)) {
    if (std::string text = in_other_unit(*scalar); !text.empty()) others.push_back(text);
  } else if (const auto* color = get_if<render::LinearRgb>(&value)) {
    if (const auto hex = nearest_hex(*color)) {
      others.push_back(exact_hex(*color) ? *hex : "≈ " + *hex);
    }
  }
  return others;
}

std::optional<std::string> nearest_hex(render::LinearRgb color) {
  if (!is_displayable(color)) return std::nullopt;
  const auto code = [](double v) { return render::to_code8(render::Tone::Srgb, v); };
  return fmt::format("#{:02x}{:02x}{:02x}", code(color.r), code(color.g), code(color.b));
}

std::optional<std::string> exact_hex(render::LinearRgb color) {
  std::optional<std::string> hex = nearest_hex(color);
  return hex && decode_hex_color(*hex) == color ? hex : std::nullopt;
}

}  // namespace sdlc::lang
