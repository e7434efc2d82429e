#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

/// The facts about what can be written in a scene: the one place where a property, a material or a
/// key of the JSON config format is described. Checkers, lowering, reference pages and schemas read
/// it.
namespace sdlc::lang {

/// The type of a value, for checks and messages.
enum class Type : std::uint8_t {
  Number,
  WholeNumber,
  Bool,
  String,
  Vec3,    ///< a point or a displacement, in metres
  Length,  ///< in metres
  Angle,   ///< written with a unit: 40deg
  Angles,  ///< three of them
  Color,
  Interval,  ///< two times in seconds
  Frames,    ///< two whole numbers
  Word,      ///< one of the property's words, or a name
  Material,
  Motion,
};

/// "a number", "a colour": what a message calls the type.
std::string_view describe(Type type) noexcept;

/// Which values of the type are allowed.
enum class Range : std::uint8_t {
  Any,
  NonNegative,
  NonNegativeExact,  ///< at most 2^53: up to there a double holds every whole number
  Positive,
  AtLeastOne,
  ByteCode,                ///< 0 to 255
  Fraction,                ///< 0 to 1
  PositiveFraction,        ///< the same without 0
  Kelvin,                  ///< where the colour of a black body is known: 1667 to 25000
  BetweenZeroAndHalfTurn,  ///< both ends excluded
};

/// "greater than 0": what a message calls the range.
std::string_view describe(Range range) noexcept;

/// The value if nothing is written; monostate if there is none. A triple is a vector or a linear
/// colour.
using Default = std::variant<std::monostate, double, bool, std::string_view, std::array<double, 3>>;

enum class Presence : std::uint8_t { Optional, Required };

/// One property of an object or one argument of a material.
struct Property {
  std::string_view name;
  Type type;
  Range range = Range::Any;
  Presence presence = Presence::Optional;
  Default default_value = {};
  std::string_view default_text = {};            ///< as the language spells it; empty: no default
  std::span<const std::string_view> words = {};  ///< of Type::Word; empty: any name
  bool reads_none = false;                       ///< the word `none` is a value too
  std::string_view doc;
};

enum class ObjectKind : std::uint8_t { Camera, Background, Sphere, Render, Group, Animation };

/// A kind of object and its table of properties.
struct Kind {
  ObjectKind id;
  std::string_view name;  ///< as the language writes it
  bool takes_name;        ///< `camera main { … }`
  bool is_unique;         ///< at most one in a file
  bool is_setting;        ///< at the top level only, and not taken from an included file
  std::span<const Property> properties;
  std::string_view doc;
};

enum class MaterialKind : std::uint8_t { Diffuse, Specular, Transmissive, Emissive, Unlit };

/// A material constructor of the language: its arguments are properties.
struct MaterialInfo {
  MaterialKind id;
  std::string_view name;       ///< as the language writes it
  std::string_view json_name;  ///< as the JSON format's `type` writes it
  std::span<const Property> arguments;
  std::string_view doc;
};

std::span<const Kind> all_kinds() noexcept;
const Kind& kind_info(ObjectKind kind) noexcept;
std::span<const MaterialInfo> all_materials() noexcept;
const MaterialInfo& material_info(MaterialKind kind) noexcept;

/// The tables of lang/schema/kinds.cpp, in the order in which `properties` holds them: the index of
/// a property in its table is the index of its value in an Object.
namespace camera_property {
enum : std::size_t { kFrom, kAt, kUp, kFov, kViewHeight, kAspect, kShutter, kCount };
}
namespace background_property {
enum : std::size_t { kColor, kBottom, kTop, kCount };
}
namespace sphere_property {
enum : std::size_t { kCenter, kRadius, kMaterial, kMotion, kCount };
}
namespace render_property {
enum : std::size_t {
  kWidth,
  kHeight,
  kSamples,
  kDepth,
  kOutput,
  kTone,
  kCamera,
  kSeed,
  kThreads,
  kPrecision,
  kSampler,
  kLightSampling,
  kError,
  kCount
};
}
namespace group_property {
enum : std::size_t { kTranslate, kRotate, kScale, kMaterial, kCount };
}
namespace animation_property {
enum : std::size_t { kFrames, kFps, kStep, kCount };
}
inline constexpr std::size_t kMaxProperties = std::max<std::size_t>(
    {camera_property::kCount, background_property::kCount, sphere_property::kCount,
     render_property::kCount, group_property::kCount, animation_property::kCount});

/// The shape of a value in the JSON config format.
enum class JsonType : std::uint8_t {
  Number,
  WholeNumber,
  Bool,
  String,
  Triple,  ///< [x, y, z]
  Color,   ///< [red, green, blue], 255 = 1, linear
  Degrees,
  Interval,  ///< [from, to]
  Movement,  ///< [[x, y, z], from, to]
  Object,
  Material,
  Spheres,
};

std::string_view describe(JsonType type) noexcept;

struct JsonObject;

/// The meaning of a key that is not a single property.
enum class JsonSetting : std::uint8_t { None, GammaCorrect, InParallel, NumberCores };

/// One key of an object of the JSON config format.
struct JsonKey {
  std::string_view key;
  JsonType type;
  Presence presence = Presence::Optional;
  /// Where the value goes: a property of `target`, whose range it must meet too. No target: see
  /// `object` and `setting`; with neither, the key has no effect.
  const Kind* target = nullptr;
  std::size_t property = 0;
  const JsonObject* object = nullptr;  ///< of Object: what is inside
  JsonSetting setting = JsonSetting::None;
  Range range = Range::Any;  ///< of keys without a target
  std::string_view doc = {};
};

struct JsonObject {
  std::string_view name;  ///< what a message calls it: "the camera"
  std::span<const JsonKey> keys;
};

/// The whole config. `camera`, `rendering` and `saving` are required unless there is an `image`.
const JsonObject& json_config() noexcept;
const JsonObject& json_sphere() noexcept;
/// The key of a property of the language; empty if the format has none.
std::string_view json_key_of(const Kind& kind, std::size_t property) noexcept;
/// The keys of a material of this kind beside `type`: one per argument that the format has.
std::span<const JsonKey> json_material_keys(MaterialKind kind) noexcept;

}  // namespace sdlc::lang
