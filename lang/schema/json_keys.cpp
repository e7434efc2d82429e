#include <array>

#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

/// A key whose value is a property of a kind. Its documentation is that of the property unless the
/// format says something else.
JsonKey optional(std::string_view name, JsonType type, ObjectKind target, std::size_t property,
                 std::string_view doc = {}) {
  const Kind& kind = kind_info(target);
  return {.key = name,
          .type = type,
          .target = &kind,
          .property = property,
          .range = kind.properties[property].range,
          .doc = doc};
}

JsonKey required(JsonKey key) {
  key.presence = Presence::Required;
  return key;
}

JsonKey required(std::string_view name, JsonType type, ObjectKind target, std::size_t property,
                 std::string_view doc = {}) {
  return required(optional(name, type, target, property, doc));
}

JsonKey object(std::string_view name, const JsonObject& inside, std::string_view doc) {
  return {.key = name, .type = JsonType::Object, .object = &inside, .doc = doc};
}

/// A key whose value is an argument of a material.
JsonKey argument(std::string_view name, JsonType type, MaterialKind material,
                 std::size_t property) {
  return {.key = name,
          .type = type,
          .presence = Presence::Required,
          .property = property,
          .range = material_info(material).arguments[property].range};
}

const JsonObject& json_camera() {
  using namespace camera_property;
  using enum JsonType;
  constexpr auto kCamera = ObjectKind::Camera;
  static const auto keys = std::to_array<JsonKey>({
      required("look_from", Triple, kCamera, kFrom),
      required("look_at", Triple, kCamera, kAt),
      required("up", Triple, kCamera, kUp),
      required(
          "vfov", Degrees, kCamera, kFov,
          "The vertical angle of view, from the bottom of the picture to its top, in degrees."),
      required(
          {.key = "focal_length", .type = Number, .doc = "Has no effect: everything is in focus."}),
      required("aspect_ratio", Number, kCamera, kAspect),
      required(
          "viewport_height", Number, kCamera, kViewHeight,
          "The view plane at distance 1 is viewport_height * tan(vfov / 2) high; at 2, vfov is "
          "the angle of view."),
      required("samples_per_pixel", WholeNumber, ObjectKind::Render, render_property::kSamples),
      optional("time_interval", Interval, kCamera, kShutter,
               "The times at which the shutter opens and closes; absent: nothing moves."),
  });
  static const JsonObject object{.name = "the camera", .keys = keys};
  return object;
}

const JsonObject& json_rendering() {
  using namespace render_property;
  static const auto keys = std::to_array<JsonKey>({
      required("width", JsonType::WholeNumber, ObjectKind::Render, kWidth),
      required("render_depth", JsonType::WholeNumber, ObjectKind::Render, kDepth),
      {.key = "in_parallel",
       .type = JsonType::Bool,
       .setting = JsonSetting::InParallel,
       .doc = "false: one thread."},
      {.key = "number_cores",
       .type = JsonType::WholeNumber,
       .setting = JsonSetting::NumberCores,
       .range = Range::NonNegative,
       .doc = "Number of threads; 0 or too many: all of the machine."},
  });
  static const JsonObject object{.name = "rendering", .keys = keys};
  return object;
}

const JsonObject& json_saving() {
  static const auto keys = std::to_array<JsonKey>({
      optional("path", JsonType::String, ObjectKind::Render, render_property::kOutput,
               "The picture's file; its folder is created; the extension selects the format."),
      {.key = "gamma_correct",
       .type = JsonType::Bool,
       .setting = JsonSetting::GammaCorrect,
       .doc = "true: saves the square root of the linear value; else the linear value."},
  });
  static const JsonObject object{.name = "saving", .keys = keys};
  return object;
}

const JsonObject& json_image() {
  using enum JsonType;
  static const auto keys = std::to_array<JsonKey>({
      required("width", WholeNumber, ObjectKind::Render, render_property::kWidth),
      required("height", WholeNumber, ObjectKind::Render, render_property::kHeight),
      required("color", Color, ObjectKind::Background, background_property::kColor),
  });
  static const JsonObject object{.name = "the image", .keys = keys};
  return object;
}

}  // namespace

const JsonObject& json_config() noexcept {
  static const auto keys = std::to_array<JsonKey>({
      optional("background", JsonType::Color, ObjectKind::Background, background_property::kColor,
               "Radiance from all directions, 255 = 1; absent: a gradient from white up to light "
               "blue."),
      required(object("camera", json_camera(), "The camera of the picture.")),
      required(object("rendering", json_rendering(), "Settings of the renderer.")),
      required(object("saving", json_saving(), "Where the picture is saved.")),
      {.key = "spheres", .type = JsonType::Spheres, .doc = "The spheres of the scene."},
      object("image", json_image(),
             "A plain picture of one colour, instead of camera, rendering and spheres."),
  });
  static const JsonObject object{.name = "the config", .keys = keys};
  return object;
}

const JsonObject& json_sphere() noexcept {
  using namespace sphere_property;
  constexpr auto kSphere = ObjectKind::Sphere;
  static const auto keys = std::to_array<JsonKey>({
      required("origin", JsonType::Triple, kSphere, kCenter),
      required("radius", JsonType::Number, kSphere, kRadius),
      required("material", JsonType::Material, kSphere, kMaterial,
               "How the surface scatters light; its type determines the other keys."),
      optional("movement", JsonType::Movement, kSphere, kMotion,
               "[target, from, to]: at its origin at time from, at target at time to, in linear "
               "motion also before and after."),
  });
  static const JsonObject object{.name = "a sphere", .keys = keys};
  return object;
}

std::string_view json_key_of(const Kind& kind, std::size_t property) noexcept {
  for (const JsonObject* object : {&json_camera(), &json_rendering(), &json_saving(), &json_image(),
                                   &json_config(), &json_sphere()}) {
    for (const JsonKey& key : object->keys) {
      if (key.target == &kind && key.property == property) return key.key;
    }
  }
  return {};
}

std::span<const JsonKey> json_material_keys(MaterialKind kind) noexcept {
  using enum MaterialKind;
  using enum JsonType;
  static const auto plain = std::to_array<JsonKey>({argument("color", Color, Diffuse, 0)});
  static const auto specular = std::to_array<JsonKey>(
      {argument("color", Color, Specular, 0), argument("fuzz", Number, Specular, 1)});
  static const auto transmissive =
      std::to_array<JsonKey>({argument("color", Color, Transmissive, 0),
                              argument("refraction_index", Number, Transmissive, 1)});
  static const auto emissive = std::to_array<JsonKey>(
      {argument("color", Color, Emissive, 0), argument("intensity", Number, Emissive, 1)});
  switch (kind) {
    case Specular: return specular;
    case Transmissive: return transmissive;
    case Emissive: return emissive;
    case Diffuse:
    case Unlit: break;
  }
  return plain;
}

std::string_view describe(JsonType type) noexcept {
  switch (type) {
    case JsonType::Number: return "a number";
    case JsonType::WholeNumber: return "a whole number";
    case JsonType::Bool: return "true or false";
    case JsonType::String: return "a string";
    case JsonType::Triple: return "three numbers [x, y, z]";
    case JsonType::Color: return "a colour [red, green, blue]";
    case JsonType::Degrees: return "a number of degrees";
    case JsonType::Interval: return "two numbers [from, to]";
    case JsonType::Movement: return "[[x, y, z], from, to]";
    case JsonType::Object: return "an object { … }";
    case JsonType::Material: return "an object { \"type\": … }";
    case JsonType::Spheres: return "an array of spheres";
  }
  return "";
}

}  // namespace sdlc::lang
