#include "lang/value/constructors.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <vector>

#include <fmt/format.h>

#include "lang/value/colors.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kCodes = std::to_array<Property>({
    {.name = "r",
     .type = Type::Number,
     .range = Range::ByteCode,
     .presence = Presence::Required,
     .doc = "Red."},
    {.name = "g",
     .type = Type::Number,
     .range = Range::ByteCode,
     .presence = Presence::Required,
     .doc = "Green."},
    {.name = "b",
     .type = Type::Number,
     .range = Range::ByteCode,
     .presence = Presence::Required,
     .doc = "Blue."},
});

constexpr auto kComponents = std::to_array<Property>({
    {.name = "r", .type = Type::Number, .presence = Presence::Required, .doc = "Red."},
    {.name = "g", .type = Type::Number, .presence = Presence::Required, .doc = "Green."},
    {.name = "b", .type = Type::Number, .presence = Presence::Required, .doc = "Blue."},
});

constexpr auto kHsl = std::to_array<Property>({
    {.name = "hue",
     .type = Type::Angle,
     .presence = Presence::Required,
     .doc = "`0deg` is red, `120deg` green, `240deg` blue."},
    {.name = "saturation",
     .type = Type::Number,
     .range = Range::Fraction,
     .presence = Presence::Required,
     .doc = "`0%` is grey, `100%` pure."},
    {.name = "lightness",
     .type = Type::Number,
     .range = Range::Fraction,
     .presence = Presence::Required,
     .doc = "`0%` is black, `100%` white."},
});

constexpr auto kKelvin = std::to_array<Property>({
    {.name = "temperature",
     .type = Type::Number,
     .range = Range::Kelvin,
     .presence = Presence::Required,
     .doc = "In kelvins: 2700 is a light bulb, 6500 daylight."},
});

constexpr auto kLine = std::to_array<Property>({
    {.name = "to",
     .type = Type::Vec3,
     .presence = Presence::Required,
     .doc = "Position of the centre at the end of `over`."},
    {.name = "over",
     .type = Type::Interval,
     .presence = Presence::Required,
     .doc = "Begin and end of the motion, in seconds of the film; not equal."},
});

double number(const ConstructorArguments& arguments, std::size_t i) {
  return get<Scalar>(arguments[i]).value;
}

Value make_rgb(const Constructor& /*self*/, const ConstructorArguments& in) {
  return render::LinearRgb{decode_srgb(number(in, 0)), decode_srgb(number(in, 1)),
                           decode_srgb(number(in, 2))};
}

std::uint64_t steps_of_hsl(const ConstructorArguments& /*in*/) { return 350; }

Value make_linear(const Constructor& /*self*/, const ConstructorArguments& in) {
  return render::LinearRgb{number(in, 0), number(in, 1), number(in, 2)};
}

Value make_linear255(const Constructor& /*self*/, const ConstructorArguments& in) {
  return render::LinearRgb{number(in, 0) / 255, number(in, 1) / 255, number(in, 2) / 255};
}

Value make_hsl(const Constructor& /*self*/, const ConstructorArguments& in) {
  return decode_hsl(get<Angle>(in[0]).degrees, number(in, 1), number(in, 2));
}

Value make_kelvin(const Constructor& /*self*/, const ConstructorArguments& in) {
  return color_of_temperature(number(in, 0));
}

Value make_line(const Constructor& /*self*/, const ConstructorArguments& in) {
  return MotionValue{get<Triple>(in[0]).value, *value_as<render::Interval>(in[1])};
}

Value make_material(const Constructor& self, const ConstructorArguments& in) {
  const auto materials = all_materials();
  const auto info = std::find_if(materials.begin(), materials.end(), [&](const MaterialInfo& m) {
    return m.arguments.data() == self.parameters.data();
  });
  MaterialValue material{.kind = info->id, .color = {}, .parameter = 0, .exact_fresnel = false};
  // A material has at most one argument of each type, so the type decides.
  for (const Value& value : in) {
    if (const auto* color = get_if<render::LinearRgb>(&value)) material.color = *color;
    if (const auto* parameter = get_if<Scalar>(&value)) material.parameter = parameter->value;
    if (const auto* word = get_if<Word>(&value)) material.exact_fresnel = word->text == "exact";
  }
  return material;
}

}  // namespace

std::span<const Constructor> all_constructors() noexcept {
  static const std::vector<Constructor> constructors = [] {
    std::vector<Constructor> all{
        {"rgb", kCodes, "A colour from sRGB values, 0 to 255, as in CSS and image editors.",
         make_rgb},
        {"linear", kComponents,
         "A colour from linear components; 1 is white, larger values are brighter.", make_linear},
        {"linear255", kComponents,
         "A colour from linear components; 255 is white, as in JSON configs.", make_linear255},
        {"hsl", kHsl, "A colour from hue, saturation and lightness, as in CSS.", make_hsl,
         steps_of_hsl},
        {"kelvin", kKelvin,
         "The colour of a black body, scaled to a largest component of 1 (Kim et al.).",
         make_kelvin},
        {"line", kLine,
         "A straight motion of a sphere's centre: at `center` when `over` begins, at `to` when it "
         "ends, extrapolated before and after.",
         make_line}};
    for (const MaterialInfo& material : all_materials())
      all.push_back({material.name, material.arguments, material.doc, make_material});
    return all;
  }();
  return constructors;
}

std::size_t Constructor::index() const noexcept {
  return static_cast<std::size_t>(this - all_constructors().data());
}

std::string signature_of(const Constructor& constructor) {
  std::string parameters;
  for (const Property& parameter : constructor.parameters) {
    parameters += fmt::format("{}{}", parameters.empty() ? "" : ", ", parameter.name);
    if (!parameter.default_text.empty()) parameters += fmt::format(": {}", parameter.default_text);
  }
  return fmt::format("{}({})", constructor.name, parameters);
}

std::string_view result_of(const Constructor& constructor) noexcept {
  if (constructor.construct == make_line) return {};
  return constructor.construct == make_material ? "material" : "color";
}

const Constructor* find_constructor(std::string_view name) noexcept {
  static const std::unordered_map<std::string_view, const Constructor*> by_name = [] {
    std::unordered_map<std::string_view, const Constructor*> map;
    for (const Constructor& constructor : all_constructors())
      map.emplace(constructor.name, &constructor);
    return map;
  }();
  const auto found = by_name.find(name);
  return found == by_name.end() ? nullptr : found->second;
}

Value default_of(const Property& parameter) {
  if (const auto* number = get_if<double>(&parameter.default_value)) return Scalar{*number};
  if (const auto* word = get_if<std::string_view>(&parameter.default_value))
    return Word{std::string(*word)};
  if (const auto* triple = get_if<std::array<double, 3>>(&parameter.default_value)) {
    return render::LinearRgb{(*triple)[0], (*triple)[1], (*triple)[2]};
  }
  return {};
}

}  // namespace sdlc::lang
