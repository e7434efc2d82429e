#include "lang/schema/habits.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace sdlc::lang {
namespace {

struct HabitRow {
  std::string_view name;
  Habit habit;
};

constexpr std::string_view kOnlySpheres = "spheres are the only shapes there are";
constexpr std::string_view kColorOfSphere =
    "the colour belongs to the material: `material: diffuse(color: …)`";
constexpr std::string_view kLights =
    "what shines is a sphere with `material: emissive(color: white, intensity: 8)`";
constexpr std::string_view kMaterials =
    "a material is a value: `let gold = specular(color: #ffd700)`";
constexpr std::string_view kPlaces =
    "`group { translate: …, rotate: …, scale: … }` places what stands in it";

constexpr auto kKinds = std::to_array<HabitRow>({
    {"ball", {.meant = "sphere"}},
    {"sky", {.meant = "background"}},
    {"environment", {.meant = "background"}},
    {"world", {.meant = "background"}},
    {"settings", {.meant = "render"}},
    {"rendering", {.meant = "render"}},
    {"film", {.meant = "render"}},
    {"global_settings", {.meant = "render"}},
    {"light", {.help = kLights}},
    {"lamp", {.help = kLights}},
    {"light_source", {.help = kLights}},
    {"point_light", {.help = kLights}},
    {"area_light", {.help = kLights}},
    {"sun", {.help = kLights}},
    {"box", {.help = kOnlySpheres}},
    {"cube", {.help = kOnlySpheres}},
    {"cylinder", {.help = kOnlySpheres}},
    {"mesh", {.help = kOnlySpheres}},
    {"torus", {.help = kOnlySpheres}},
    {"triangle", {.help = kOnlySpheres}},
    {"plane", {.help = "spheres are the only shapes there are; a ground is a very large one"}},
    {"ground", {.help = "a ground is a very large sphere: `sphere ground { … radius: 1000 }`"}},
    {"floor", {.help = "a floor is a very large sphere: `sphere floor { … radius: 1000 }`"}},
    {"material", {.help = kMaterials}},
    {"texture", {.help = kMaterials}},
    {"transform", {.help = kPlaces}},
    {"translate", {.help = kPlaces}},
    {"rotate", {.help = kPlaces}},
    {"scale", {.help = kPlaces}},
    {"union", {.help = kPlaces}},
    {"do", {.help = kNoLoop}},
    {"module", {.help = kOwnKind}},
    {"object", {.help = kOwnKind}},
});

constexpr auto kCameraProperties = std::to_array<HabitRow>({
    {"position", {.meant = "from"}},
    {"location", {.meant = "from"}},
    {"origin", {.meant = "from"}},
    {"eye", {.meant = "from"}},
    {"target", {.meant = "at"}},
    {"lookat", {.meant = "at"}},
    {"to", {.meant = "at"}},
    {"angle", {.meant = "fov"}},
    {"fovy", {.meant = "fov"}},
    {"field_of_view", {.meant = "fov"}},
});

constexpr auto kSphereProperties = std::to_array<HabitRow>({
    {"position", {.meant = "center"}},
    {"pos", {.meant = "center"}},
    {"location", {.meant = "center"}},
    {"centre", {.meant = "center"}},
    {"at", {.meant = "center"}},
    {"size", {.meant = "radius"}},
    {"r", {.meant = "radius"}},
    {"diameter", {.help = "write half of it as `radius`", .in_place_of = "radius"}},
    {"color", {.help = kColorOfSphere, .in_place_of = "material"}},
    {"colour", {.help = kColorOfSphere, .in_place_of = "material"}},
    {"texture", {.meant = "material"}},
    {"translate", {.help = "a sphere has a `center`; groups are translated"}},
    {"rotate", {.help = "spheres look the same from all sides; groups are rotated"}},
    {"scale", {.help = "a sphere has a `radius`; groups are scaled"}},
});

constexpr auto kRenderProperties = std::to_array<HabitRow>({
    {"spp", {.meant = "samples"}},
    {"max_depth", {.meant = "depth"}},
    {"bounces", {.meant = "depth"}},
    {"file", {.meant = "output"}},
    {"filename", {.meant = "output"}},
    {"size", {.help = "a picture has a `width` and a `height`"}},
    {"resolution", {.help = "a picture has a `width` and a `height`"}},
    {"gamma", {.help = "write `tone: srgb`, or `sqrt` or `linear`"}},
});

constexpr auto kBackgroundProperties = std::to_array<HabitRow>({
    {"colour", {.meant = "color"}},
    {"horizon", {.meant = "bottom"}},
    {"zenith", {.meant = "top"}},
});

constexpr auto kGroupProperties = std::to_array<HabitRow>({
    {"position", {.meant = "translate"}},
    {"center", {.meant = "translate"}},
    {"rotation", {.meant = "rotate"}},
    {"size", {.meant = "scale"}},
});

constexpr auto kAnimationProperties = std::to_array<HabitRow>({
    {"rate", {.meant = "fps"}},
    {"framerate", {.meant = "fps"}},
    {"range", {.meant = "frames"}},
});

constexpr auto kFunctions = std::to_array<HabitRow>({
    {"pow", {.help = "a power is written `x ^ y`"}},
    {"sqr", {.help = "a square is written `x ^ 2`"}},
    {"squareroot", {.meant = "sqrt"}},
    {"ln", {.meant = "log"}},
    {"ceiling", {.meant = "ceil"}},
    {"fmod", {.meant = "mod"}},
    {"lerp", {.meant = "mix"}},
    {"rand", {.meant = "random"}},
    {"magnitude", {.meant = "length"}},
    {"size", {.meant = "len"}},
    {"rgba", {.meant = "rgb"}},
    {"hsv", {.meant = "hsl"}},
    {"vec3", {.help = "a point is written `(x, y, z)`"}},
    {"vector", {.help = "a point is written `(x, y, z)`"}},
    {"point", {.help = "a point is written `(x, y, z)`"}},
    {"radians", {.help = "an angle is a number with a unit: `x * 1rad`"}},
    {"degrees", {.help = "an angle is a number with a unit: `x * 1deg`"}},
    {"deg", {.help = "an angle is a number with a unit: `x * 1deg`"}},
    {"print", {.help = "`sdlc inspect` tells what a scene is made of"}},
    {"lambertian", {.meant = "diffuse"}},
    {"matte", {.meant = "diffuse"}},
    {"mirror", {.meant = "specular"}},
    {"metal", {.meant = "specular"}},
    {"reflective", {.meant = "specular"}},
    {"glass", {.meant = "transmissive"}},
    {"dielectric", {.meant = "transmissive"}},
    {"refractive", {.meant = "transmissive"}},
    {"light", {.meant = "emissive"}},
    {"emission", {.meant = "emissive"}},
    {"no_texture", {.meant = "unlit"}},
    {"flat", {.meant = "unlit"}},
});

constexpr auto kArguments = std::to_array<HabitRow>({
    {"refraction_index", {.meant = "ior"}},
    {"refractive_index", {.meant = "ior"}},
    {"index", {.meant = "ior"}},
    {"colour", {.meant = "color"}},
    {"albedo", {.meant = "color"}},
    {"roughness", {.meant = "fuzz"}},
    {"strength", {.meant = "intensity"}},
    {"power", {.meant = "intensity"}},
});

constexpr auto kTypes = std::to_array<HabitRow>({
    {"int", {.meant = "number"}},
    {"integer", {.meant = "number"}},
    {"float", {.meant = "number"}},
    {"double", {.meant = "number"}},
    {"real", {.meant = "number"}},
    {"str", {.meant = "string"}},
    {"text", {.meant = "string"}},
    {"boolean", {.meant = "bool"}},
    {"vector", {.meant = "vec3"}},
    {"point", {.meant = "vec3"}},
    {"rgb", {.meant = "color"}},
    {"colour", {.meant = "color"}},
    {"array", {.meant = "list"}},
});

constexpr std::string_view kNothing = "there is no empty value: leave out what is not wanted";

constexpr auto kNames = std::to_array<HabitRow>({
    {"null", {.help = kNothing}},
    {"NULL", {.help = kNothing}},
    {"None", {.help = kNothing}},
    {"nil", {.help = kNothing}},
    {"undefined", {.help = kNothing}},
    {"True", {.meant = "true"}},
    {"TRUE", {.meant = "true"}},
    {"yes", {.meant = "true"}},
    {"on", {.meant = "true"}},
    {"False", {.meant = "false"}},
    {"FALSE", {.meant = "false"}},
    {"no", {.meant = "false"}},
    {"off", {.meant = "false"}},
    {"M_PI", {.meant = "pi"}},
    {"inf", {.help = "there is no infinity; a very large number is `1e9`"}},
    {"infinity", {.help = "there is no infinity; a very large number is `1e9`"}},
});

/// What other languages keep their functions of numbers in.
constexpr auto kLibraries = std::to_array<std::string_view>({"math", "Math", "numpy", "np", "std"});

std::optional<Habit> find(std::span<const HabitRow> rows, std::string_view name) noexcept {
  const auto found = std::ranges::find(rows, name, &HabitRow::name);
  return found == rows.end() ? std::nullopt : std::optional(found->habit);
}

std::span<const HabitRow> habits_of(ObjectKind kind) noexcept {
  switch (kind) {
    case ObjectKind::Camera: return kCameraProperties;
    case ObjectKind::Background: return kBackgroundProperties;
    case ObjectKind::Sphere: return kSphereProperties;
    case ObjectKind::Render: return kRenderProperties;
    case ObjectKind::Group: return kGroupProperties;
    case ObjectKind::Animation: return kAnimationProperties;
  }
  return {};
}

}  // namespace

std::optional<Habit> kind_habit(std::string_view name) noexcept { return find(kKinds, name); }

std::optional<Habit> property_habit(const Kind& kind, std::string_view name) noexcept {
  for (std::size_t i = 0; i < kind.properties.size(); ++i) {
    if (json_key_of(kind, i) == name) return Habit{.meant = kind.properties[i].name};
  }
  return find(habits_of(kind.id), name);
}

std::optional<Habit> function_habit(std::string_view name) noexcept {
  return find(kFunctions, name);
}

std::optional<Habit> argument_habit(std::string_view name) noexcept {
  return find(kArguments, name);
}

std::optional<Habit> name_habit(std::string_view name) noexcept { return find(kNames, name); }

bool is_foreign_library(std::string_view name) noexcept {
  return std::ranges::find(kLibraries, name) != kLibraries.end();
}

std::optional<Habit> type_habit(std::string_view name) noexcept { return find(kTypes, name); }

}  // namespace sdlc::lang
