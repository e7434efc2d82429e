#include "lang/repair/habits.hpp"

#include <algorithm>
#include <array>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kOnlySpheres = "spheres are the only shapes there are";
constexpr std::string_view kLights =
    "what shines is a sphere with `material: emissive(color: white, intensity: 8)`";
constexpr std::string_view kMaterials =
    "a material is a value: `let gold = specular(color: #ffd700)`";
constexpr std::string_view kMaterialOf =
    "a material is a value: `material: diffuse(color: …)` in a sphere, or `let name = diffuse(…)`";
constexpr std::string_view kPlaces =
    "`group { translate: …, rotate: …, scale: … }` places what it contains";
constexpr std::string_view kColor =
    "the colour belongs to the material: `material: diffuse(color: …)`";
constexpr std::string_view kOwnKind = "a user-defined kind begins with `def name(…) { … }`";
constexpr std::string_view kElseIf = "write `if … { … } else if … { … }`";
constexpr std::string_view kSize = "a picture has a `width` and a `height`";
constexpr std::string_view kPoint = "a point is written `(x, y, z)`";
constexpr std::string_view kAngle = "an angle is a number with a unit: `x * 1deg`";
constexpr std::string_view kNothing = "there is no empty value: omit the property";
constexpr std::string_view kInfinity = "there is no infinity; a very large number is `1e9`";
constexpr std::string_view kComments = "comments are `// …` and `/* … */`";
constexpr std::string_view kNoChange = "values never change";
constexpr std::string_view kQuotes = "these are the quotes of a word processor";

/// The words of a row are separated by spaces.
struct Row {
  HabitPlace place;
  std::string_view words;
  Habit habit;
};

using enum HabitPlace;

// clang-format off
constexpr auto kRows = std::to_array<Row>({
    {Sign, "<!-- -->", {"", kComments}},
    {Sign, "&&", {"and"}},
    {Sign, "||", {"or"}},
    {Sign, "!== <>", {"!="}},
    {Sign, "===", {"=="}},
    {Sign, "!", {"not "}},
    {Sign, "=>", {"", "a function is `fn f(x) = …`; at least is written `>=`"}},
    {Sign, "->", {"", "the type of a result goes without saying: `fn f(x) = …`"}},
    {Sign, "=< ≤", {"<="}},
    {Sign, "≥", {">="}},
    {Sign, "≠", {"!="}},
    {Sign, "**", {"^"}},
    {Sign, "++ += -= *= /=", {"", kNoChange}},
    {Sign, "%", {"", "the remainder of a division is `mod(a, b)`"}},
    {Sign, "?", {"", "write `if … then … else …`"}},
    {Sign, ";", {"", "statements have no end mark"}},
    {Sign, "...", {"..", "an interval is `a .. b`, and a list of numbers `range(a, b)`"}},
    {Sign, "…", {".."}},
    {Sign, "°", {"deg"}},
    {Sign, "−", {"-", "this is the minus of a word processor"}},
    {Sign, "–", {"-", "this is a dash"}},
    {Sign, "× ·", {"*"}},
    {Sign, "÷", {"/"}},
    {Sign, "“ ” „ ‘ ’", {"\"", kQuotes}},

    {ValueWord, "var val const auto int float double number bool string vec3 color material #declare #local", {"let"}},
    {FunctionWord, "function func fun", {"fn"}},
    {DefinitionWord, "define module", {"def"}},
    {LoopWord, "foreach", {"for"}},
    {StatementWord, "while do repeat loop", {"", kNoLoop}},
    {StatementWord, "return", {"", kFunction}},
    {StatementWord, "pass", {"", "a block may be empty: `{ }`"}},
    {StatementWord, "module class", {"", kOwnKind}},
    {StatementWord, "where", {"", "names of parts of a value come first: `let a = 1 in a + 2`"}},
    {StatementWord, "switch match", {"", kElseIf}},
    {ElseIf, "elif elseif elsif", {"else if"}},

    {Unit, "degree degrees", {"deg"}},
    {Unit, "radians", {"rad"}},
    {Unit, "turns", {"turn"}},
    {Unit, "meter meters metre metres", {"m"}},
    {Unit, "sec secs second seconds", {"s"}},
    {Unit, "msec", {"ms"}},
    {Unit, "percent", {"%"}},
    {Unit, "μm µm", {"", "a micrometre is `1e-3mm`"}},
    {Unit, "π", {"", "write `2 * pi` for 2π"}},

    {Kind, "ball", {"sphere"}},
    {Kind, "sky environment world", {"background"}},
    {Kind, "settings rendering film global_settings", {"render"}},
    {Kind, "light lamp light_source point_light area_light sun", {"", kLights}},
    {Kind, "box cube cylinder mesh torus triangle", {"", kOnlySpheres}},
    {Kind, "plane", {"", "spheres are the only shapes there are; a ground is a very large one"}},
    {Kind, "ground", {"", "a ground is a very large sphere: `sphere ground { … radius: 1000 }`"}},
    {Kind, "floor", {"", "a floor is a very large sphere: `sphere floor { … radius: 1000 }`"}},
    {Kind, "material texture", {"", kMaterials}},
    {Kind, "diffuse specular transmissive emissive unlit", {"", kMaterialOf}},
    {Kind, "transform translate rotate scale union", {"", kPlaces}},
    {Kind, "do", {"", kNoLoop}},
    {Kind, "module object", {"", kOwnKind}},

    {CameraProperty, "position location origin eye", {"from"}},
    {CameraProperty, "target lookat to", {"at"}},
    {CameraProperty, "angle fovy field_of_view", {"fov"}},
    {SphereProperty, "position pos location centre at", {"center"}},
    {SphereProperty, "size r", {"radius"}},
    {SphereProperty, "diameter", {"", "write half of it as `radius`", "radius"}},
    {SphereProperty, "color colour", {"", kColor, "material"}},
    {SphereProperty, "texture", {"material"}},
    {SphereProperty, "translate", {"", "a sphere has a `center`; groups are translated"}},
    {SphereProperty, "rotate", {"", "spheres look the same from all sides; groups are rotated"}},
    {SphereProperty, "scale", {"", "a sphere has a `radius`; groups are scaled"}},
    {RenderProperty, "spp", {"samples"}},
    {RenderProperty, "max_depth bounces", {"depth"}},
    {RenderProperty, "file filename", {"output"}},
    {RenderProperty, "size resolution", {"", kSize}},
    {RenderProperty, "gamma", {"", "write `tone: srgb`, or `sqrt` or `linear`"}},
    {BackgroundProperty, "colour", {"color"}},
    {BackgroundProperty, "horizon", {"bottom"}},
    {BackgroundProperty, "zenith", {"top"}},
    {GroupProperty, "position pos center location", {"translate"}},
    {GroupProperty, "rotation", {"rotate"}},
    {GroupProperty, "size", {"scale"}},
    {AnimationProperty, "rate framerate", {"fps"}},
    {AnimationProperty, "range", {"frames"}},

    {Callee, "pow", {"", "a power is written `x ^ y`"}},
    {Callee, "sqr", {"", "a square is written `x ^ 2`"}},
    {Callee, "squareroot", {"sqrt"}},
    {Callee, "ln", {"log"}},
    {Callee, "ceiling", {"ceil"}},
    {Callee, "fmod", {"mod"}},
    {Callee, "lerp", {"mix"}},
    {Callee, "saturate clamp01", {"", "between 0 and 1: `clamp(x, 0, 1)`"}},
    {Callee, "frac", {"fract"}},
    {Callee, "sgn signum", {"sign"}},
    {Callee, "fabs", {"abs"}},
    {Callee, "fmin minimum", {"min"}},
    {Callee, "fmax maximum", {"max"}},
    {Callee, "trunc int", {"", "round with `floor(x)`, `ceil(x)` or `round(x)`"}},
    {Callee, "step", {"", "a step is written `if x < edge then 0 else 1`"}},
    {Callee, "smootherstep", {"smoothstep"}},
    {Callee, "map_range maprange fit rescale", {"remap"}},
    {Callee, "atan", {"", "the arctangent of y / x is `atan2(y, x)`"}},
    {Callee, "rand", {"random"}},
    {Callee, "randn rand_normal gauss gaussian normal", {"random_normal"}},
    {Callee, "perlin simplex snoise", {"noise"}},
    {Callee, "fbm turbulence", {"", "noise of several octaves is `noise(p, octaves: 4)`"}},
    {Callee, "magnitude norm", {"length"}},
    {Callee, "size count", {"len"}},
    {Callee, "average mean avg", {"", "the mean is `sum(list) / len(list)`"}},
    {Callee, "linspace arange", {"range", "`range(a, b, step)` goes from `a` in equal steps before `b`"}},
    {Callee, "sorted", {"sort"}},
    {Callee, "reversed", {"reverse"}},
    {Callee, "concat append push extend", {"", "lists are joined by `+`: `a + [b]`"}},
    {Callee, "enumerate", {"", "index and element: `for i, x in list { … }`"}},
    {Callee, "map", {"", "a function of every element: `[f(x) for x in list]`"}},
    {Callee, "filter", {"", "elements that fulfil a condition: `[x for x in list if x > 0]`"}},
    {Callee, "tostring toString to_string format", {"str"}},
    {Callee, "rgba", {"rgb"}},
    {Callee, "hsv", {"hsl"}},
    {Callee, "vec3 vector point", {"", kPoint}},
    {Callee, "radians", {"", "an angle is a number with a unit: `x * 1rad`"}},
    {Callee, "degrees deg deg2rad", {"", kAngle}},
    {Callee, "rad2deg", {"", "an angle by a unit is a number: `a / 1deg`"}},
    {Callee, "print", {"", "`sdlc inspect` shows what a scene contains"}},
    {Callee, "lambertian matte", {"diffuse"}},
    {Callee, "mirror metal reflective", {"specular"}},
    {Callee, "glass dielectric refractive", {"transmissive"}},
    {Callee, "light emission", {"emissive"}},
    {Callee, "no_texture flat", {"unlit"}},

    {Argument, "refraction_index refractive_index index", {"ior"}},
    {Argument, "colour albedo", {"color"}},
    {Argument, "roughness", {"fuzz"}},
    {Argument, "strength power", {"intensity"}},

    {Type, "int integer float double real", {"number"}},
    {Type, "str text", {"string"}},
    {Type, "boolean", {"bool"}},
    {Type, "vector point", {"vec3"}},
    {Type, "rgb colour", {"color"}},
    {Type, "array", {"list"}},

    {Name, "null NULL None nil undefined", {"", kNothing}},
    {Name, "True TRUE yes on", {"true"}},
    {Name, "False FALSE no off", {"false"}},
    {Name, "M_PI π", {"pi"}},
    {Name, "τ", {"", "write `2 * pi`"}},
    {Name, "inf infinity", {"", kInfinity}},

    {Library, "math Math numpy np std", {}},
});
// clang-format on
static_assert(std::ranges::is_sorted(kRows, {}, &Row::place), "find_habit() searches it");

/// Calls the function with each word of the row until it returns true.
template <typename Function>
bool any_word(std::string_view words, Function function) {
  while (!words.empty()) {
    const std::size_t end = std::min(words.find(' '), words.size());
    if (function(words.substr(0, end))) return true;
    words.remove_prefix(std::min(end + 1, words.size()));
  }
  return false;
}

HabitPlace properties_of(ObjectKind kind) noexcept {
  switch (kind) {
    case ObjectKind::Camera: return CameraProperty;
    case ObjectKind::Background: return BackgroundProperty;
    case ObjectKind::Sphere: return SphereProperty;
    case ObjectKind::Render: return RenderProperty;
    case ObjectKind::Group: return GroupProperty;
    case ObjectKind::Animation: return AnimationProperty;
  }
  return GroupProperty;
}

}  // namespace

std::optional<Habit> find_habit(HabitPlace place, std::string_view written) noexcept {
  for (const Row& row : std::ranges::equal_range(kRows, place, {}, &Row::place)) {
    const auto is_written = [&](std::string_view word) { return word == written; };
    if (any_word(row.words, is_written)) return row.habit;
  }
  return std::nullopt;
}

std::string_view foreign_sign_at(std::string_view text) noexcept {
  std::string_view longest;
  for (const Row& row : std::ranges::equal_range(kRows, Sign, {}, &Row::place)) {
    any_word(row.words, [&](std::string_view sign) {
      if (sign.size() > longest.size() && text.starts_with(sign)) longest = sign;
      return false;
    });
  }
  // `!=` is a sign of ours, and `...5` is `..` and a number.
  const bool is_own = (longest == "!" && text.starts_with("!=")) ||
                      (longest == "..." && text.size() > 3 && is_ascii_digit(text[3]));
  return is_own ? std::string_view() : longest;
}

bool is_color_without_sign(std::string_view text) noexcept {
  const bool has_digit = std::ranges::any_of(text, is_ascii_digit);
  return has_digit && (text.size() == 3 || text.size() == 6) &&
         std::ranges::all_of(text, is_hex_digit);
}

std::optional<Habit> property_habit(const sdlc::lang::Kind& kind, std::string_view name) noexcept {
  for (std::size_t i = 0; i < kind.properties.size(); ++i) {
    if (json_key_of(kind, i) == name) return Habit{.meant = kind.properties[i].name};
  }
  return find_habit(properties_of(kind.id), name);
}

}  // namespace sdlc::lang
