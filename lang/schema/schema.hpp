#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <variant>

/// The tables of kinds, properties, materials and JSON keys, each described only here. Checks,
/// lowering, reference pages and schemas read these tables.
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
  Angles,  ///< three angles
  Color,
  Interval,  ///< two times in seconds
  Frames,    ///< two whole numbers
  Focus,     ///< a distance, a point or the name of a sphere
  Word,      ///< one of the property's words, or any name
  Material,
  Motion,
};

/// The type in messages: "a number", "a colour".
std::string_view describe(Type type) noexcept;

/// The values of a type that are allowed.
enum class Range : std::uint8_t {
  Any,
  NonNegative,
  NonNegativeExact,  ///< 0 to 2^53: a double holds these whole numbers exactly
  Positive,
  AtLeastOne,
  ByteCode,                ///< 0 to 255
  Fraction,                ///< 0 to 1
  PositiveFraction,        ///< greater than 0, at most 1
  Kelvin,                  ///< 1667 to 25000, where the fit of black-body colours is valid
  UpToHundred,             ///< 0 to 100
  Octaves,                 ///< 1 to 32
  BetweenZeroAndHalfTurn,  ///< both ends excluded
};

/// The range in messages: "greater than 0".
std::string_view describe(Range range) noexcept;

/// The default value of a property; monostate: none. An array is a vector or a linear colour.
using Default = std::variant<std::monostate, double, bool, std::string_view, std::array<double, 3>>;

enum class Presence : std::uint8_t { Optional, Required };

/// One property of an object or one argument of a material.
struct Property {
  std::string_view name;
  Type type;
  Range range = Range::Any;
  Presence presence = Presence::Optional;
  Default default_value = {};
  std::string_view default_text = {};            ///< the default as written in a scene
  std::span<const std::string_view> words = {};  ///< for Type::Word; empty: any name
  bool reads_none = false;                       ///< the word `none` is allowed too
  std::string_view doc;
};

enum class ObjectKind : std::uint8_t { Camera, Background, Sphere, Render, Group, Animation };

/// A kind of object and its table of properties.
struct Kind {
  ObjectKind id;
  std::string_view name;    ///< in the language
  bool takes_name = false;  ///< `camera main { … }`
  bool is_unique = false;   ///< at most one per file
  bool is_setting = false;  ///< at the top level only; ignored in included files
  std::span<const Property> properties;
  std::string_view doc;
};

enum class MaterialKind : std::uint8_t { Diffuse, Specular, Transmissive, Emissive, Unlit };

/// A material constructor.
struct MaterialInfo {
  MaterialKind id;
  std::string_view name;       ///< in the language
  std::string_view json_name;  ///< value of `type` in the JSON format
  std::span<const Property> arguments;
  std::string_view doc;
};

std::span<const Kind> all_kinds() noexcept;
const Kind& kind_info(ObjectKind kind) noexcept;
std::span<const MaterialInfo> all_materials() noexcept;
const MaterialInfo& material_info(MaterialKind kind) noexcept;

/// The row numbers of properties in the tables of lang/schema/kinds.cpp, which are also the indices
/// of their slots in an Object.
namespace camera_property {
enum : std::size_t {
  kFrom,
  kAt,
  kUp,
  kFov,
  kViewHeight,
  kAspect,
  kShutter,
  kAperture,
  kFocus,
  kCount
};
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
  kExposure,
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

/// The keys of a config that do not simply give one property its value.
enum class JsonSetting : std::uint8_t { None, GammaCorrect, InParallel, NumberCores };

/// One key of an object of the JSON config format.
struct JsonKey {
  std::string_view key;
  JsonType type;
  Presence presence = Presence::Optional;
  /// The kind whose property the key sets. Null for arguments of materials, for the list of
  /// spheres, for keys with an `object` or `setting`, and for keys without effect.
  const Kind* target = nullptr;
  std::size_t property = 0;            ///< row in the table of the target or material
  const JsonObject* object = nullptr;  ///< for JsonType::Object: its keys
  JsonSetting setting = JsonSetting::None;
  Range range = Range::Any;  ///< of the value
  std::string_view doc = {};
};

struct JsonObject {
  std::string_view name;  ///< in messages: "the camera"
  std::span<const JsonKey> keys;
};

/// The whole config. `saving` is always required, `camera` and `rendering` unless there is an
/// `image`.
const JsonObject& json_config() noexcept;
const JsonObject& json_sphere() noexcept;
/// The JSON key of a property; empty if there is none.
std::string_view json_key_of(const Kind& kind, std::size_t property) noexcept;
/// The keys of a material of this kind except `type`.
std::span<const JsonKey> json_material_keys(MaterialKind kind) noexcept;

}  // namespace sdlc::lang
