#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "lang/eval/colors.hpp"
#include "lang/eval/evaluator.hpp"

namespace sdlc::lang {
namespace {

constexpr auto kComponents = std::to_array<Property>({
    {.name = "r", .type = Type::Number, .presence = Presence::Required, .doc = "Red."},
    {.name = "g", .type = Type::Number, .presence = Presence::Required, .doc = "Green."},
    {.name = "b", .type = Type::Number, .presence = Presence::Required, .doc = "Blue."},
});

constexpr auto kHsl = std::to_array<Property>({
    {.name = "hue",
     .type = Type::Angle,
     .presence = Presence::Required,
     .doc = "0deg red, 120deg green, 240deg blue."},
    {.name = "saturation",
     .type = Type::Number,
     .presence = Presence::Required,
     .doc = "0% grey, 100% pure."},
    {.name = "lightness",
     .type = Type::Number,
     .presence = Presence::Required,
     .doc = "0% black, 100% white."},
});

constexpr auto kLine = std::to_array<Property>({
    {.name = "to",
     .type = Type::Vec3,
     .presence = Presence::Required,
     .doc = "Where the centre is at the end of `over`."},
    {.name = "over",
     .type = Type::Interval,
     .presence = Presence::Required,
     .doc = "From when to when, in seconds."},
});

constexpr auto kLaterFunctions = std::to_array<std::string_view>({"kelvin"});

Computed make_material(const MaterialInfo& info, const Arguments& arguments) {
  MaterialValue material{.kind = info.id, .color = {}, .parameter = 0, .exact_fresnel = false};
  // A material has at most one argument of each type, so the type tells where the value goes.
  for (std::size_t i = 0; i < info.arguments.size(); ++i) {
    const Value& value = arguments.slots[i].value;
    if (const auto* color = std::get_if<render::LinearRgb>(&value)) material.color = *color;
    if (const auto* number = std::get_if<double>(&value)) material.parameter = *number;
    if (const auto* word = std::get_if<Word>(&value))
      material.exact_fresnel = word->text == "exact";
  }
  return material;
}

/// The number of a parameter that `largest` bounds.
class Components {
 public:
  Components(const Function& function, const Arguments& arguments, ast::Call call,
             DiagnosticSink& sink)
      : function_(function), arguments_(arguments), call_(call), sink_(sink) {}

  double number(std::size_t i) const { return std::get<double>(arguments_.slots[i].value); }
  double bounded(std::size_t i, double largest, std::string_view range) {
    const double value = number(i);
    if (value >= 0 && value <= largest) return value;
    const Location where = call_.node.tree().location(arguments_.slots[i].span);
    sink_.report(diag::out_of_range, where, function_.parameters[i].name, range, to_text(value));
    is_valid_ = false;
    return 0;
  }
  bool is_valid() const noexcept { return is_valid_; }

 private:
  const Function& function_;
  const Arguments& arguments_;
  ast::Call call_;
  DiagnosticSink& sink_;
  bool is_valid_ = true;
};

}  // namespace

std::span<const Function> all_functions() noexcept {
  static const std::vector<Function> functions = [] {
    std::vector<Function> all{{"rgb", kComponents},
                              {"linear", kComponents},
                              {"linear255", kComponents},
                              {"hsl", kHsl},
                              {"line", kLine}};
    for (const MaterialInfo& material : all_materials())
      all.push_back({material.name, material.arguments});
    return all;
  }();
  return functions;
}

const Function* find_function(std::string_view name) noexcept {
  const auto functions = all_functions();
  const auto found = std::find_if(functions.begin(), functions.end(),
                                  [&](const Function& function) { return function.name == name; });
  return found == functions.end() ? nullptr : &*found;
}

bool is_later_function(std::string_view name) noexcept {
  return std::find(kLaterFunctions.begin(), kLaterFunctions.end(), name) != kLaterFunctions.end();
}

Computed call_function(const Function& function, const Arguments& arguments, ast::Call call,
                       DiagnosticSink& sink) {
  Components in(function, arguments, call, sink);
  Computed result;
  if (function.name == "rgb") {
    const auto component = [&](std::size_t i) {
      return decode_srgb(in.bounded(i, 255, "from 0 to 255"));
    };
    result = render::LinearRgb{component(0), component(1), component(2)};
  } else if (function.name == "linear") {
    result = render::LinearRgb{in.number(0), in.number(1), in.number(2)};
  } else if (function.name == "linear255") {
    result = render::LinearRgb{in.number(0) / 255, in.number(1) / 255, in.number(2) / 255};
  } else if (function.name == "hsl") {
    const double hue = std::get<Angle>(arguments.slots[0].value).degrees;
    const double saturation = in.bounded(1, 1, "from 0 to 100%");
    result = decode_hsl(hue, saturation, in.bounded(2, 1, "from 0 to 100%"));
  } else if (function.name == "line") {
    result = MotionValue{std::get<render::Vec3>(arguments.slots[0].value),
                         std::get<render::Interval>(arguments.slots[1].value)};
  } else {
    const auto materials = all_materials();
    const auto info =
        std::find_if(materials.begin(), materials.end(),
                     [&](const MaterialInfo& material) { return material.name == function.name; });
    if (info != materials.end()) result = make_material(*info, arguments);
  }
  return in.is_valid() ? result : Failed{};
}

}  // namespace sdlc::lang
