#include <array>

#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

const Kind& camera() { return kind_info(ObjectKind::Camera); }
const Kind& background() { return kind_info(ObjectKind::Background); }
const Kind& sphere() { return kind_info(ObjectKind::Sphere); }
const Kind& render() { return kind_info(ObjectKind::Render); }

const JsonObject& json_camera() {
  using namespace camera_property;
  static const auto keys = std::to_array<JsonKey>({
      {.key = "look_from",
       .type = JsonType::Triple,
       .presence = Presence::Required,
       .target = &camera(),
       .property = kFrom},
      {.key = "look_at",
       .type = JsonType::Triple,
       .presence = Presence::Required,
       .target = &camera(),
       .property = kAt},
      {.key = "up",
       .type = JsonType::Triple,
       .presence = Presence::Required,
       .target = &camera(),
       .property = kUp},
      {.key = "vfov",
       .type = JsonType::Degrees,
       .presence = Presence::Required,
       .target = &camera(),
       .property = kFov,
       .doc = "The angle seen from the bottom of the picture to its top, in degrees."},
      {.key = "focal_length",
       .type = JsonType::Number,
       .presence = Presence::Required,
       .doc = "Has no effect: everything is in focus."},
      {.key = "aspect_ratio",
       .type = JsonType::Number,
       .presence = Presence::Required,
       .target = &camera(),
       .property = kAspect},
      {.key = "viewport_height",
       .type = JsonType::Number,
       .presence = Presence::Required,
       .target = &camera(),
       .property = kViewHeight,
       .doc = "The view plane at distance 1 is viewport_height * tan(vfov / 2) high; at 2, vfov is "
              "the angle seen."},
      {.key = "samples_per_pixel",
       .type = JsonType::WholeNumber,
       .presence = Presence::Required,
       .target = &render(),
       .property = render_property::kSamples},
      {.key = "time_interval",
       .type = JsonType::Interval,
       .target = &camera(),
       .property = kShutter,
       .doc = "When the shutter is open; absent: every sphere at its origin."},
  });
  static const JsonObject object{.name = "the camera", .keys = keys};
  return object;
}

const JsonObject& json_rendering() {
  using namespace render_property;
  static const auto keys = std::to_array<JsonKey>({
      {.key = "width",
       .type = JsonType::WholeNumber,
       .presence = Presence::Required,
       .target = &render(),
       .property = kWidth},
      {.key = "render_depth",
       .type = JsonType::WholeNumber,
       .presence = Presence::Required,
       .target = &render(),
       .property = kDepth},
      {.key = "in_parallel",
       .type = JsonType::Bool,
       .setting = JsonSetting::InParallel,
       .doc = "false: one thread."},
      {.key = "number_cores",
       .type = JsonType::WholeNumber,
       .setting = JsonSetting::NumberCores,
       .range = Range::NonNegative,
       .doc = "Threads; 0 or too many: all."},
  });
  static const JsonObject object{.name = "rendering", .keys = keys};
  return object;
}

const JsonObject& json_saving() {
  static const auto keys = std::to_array<JsonKey>({
      {.key = "path",
       .type = JsonType::String,
       .target = &render(),
       .property = render_property::kOutput,
       .doc = "The picture's file, whose folder is made with it; the extension picks the format."},
      {.key = "gamma_correct",
       .type = JsonType::Bool,
       .setting = JsonSetting::GammaCorrect,
       .doc = "true: the square root of the linear value is saved; else the linear value."},
  });
  static const JsonObject object{.name = "saving", .keys = keys};
  return object;
}

const JsonObject& json_image() {
  static const auto keys = std::to_array<JsonKey>({
      {.key = "width",
       .type = JsonType::WholeNumber,
       .presence = Presence::Required,
       .target = &render(),
       .property = render_property::kWidth},
      {.key = "height",
       .type = JsonType::WholeNumber,
       .presence = Presence::Required,
       .target = &render(),
       .property = render_property::kHeight},
      {.key = "color",
       .type = JsonType::Color,
       .presence = Presence::Required,
       .target = &background(),
       .property = background_property::kColor},
  });
  static const JsonObject object{.name = "the image", .keys = keys};
  return object;
}

}  // namespace

const JsonObject& json_config() noexcept {
  static const auto keys = std::to_array<JsonKey>({
      {.key = "background",
       .type = JsonType::Color,
       .target = &background(),
       .property = background_property::kColor,
       .doc = "Radiance from everywhere, 255 = 1; absent: a gradient from white up to light blue."},
      {.key = "camera",
       .type = JsonType::Object,
       .presence = Presence::Required,
       .object = &json_camera(),
       .doc = "Where the picture is taken from."},
      {.key = "rendering",
       .type = JsonType::Object,
       .presence = Presence::Required,
       .object = &json_rendering(),
       .doc = "How the picture is made."},
      {.key = "saving",
       .type = JsonType::Object,
       .presence = Presence::Required,
       .object = &json_saving(),
       .doc = "Where the picture goes."},
      {.key = "spheres", .type = JsonType::Spheres, .doc = "What there is to be seen."},
      {.key = "image",
       .type = JsonType::Object,
       .object = &json_image(),
       .doc = "A plain picture of one colour, in place of camera, rendering and spheres."},
  });
  static const JsonObject object{.name = "the config", .keys = keys};
  return object;
}

const JsonObject& json_sphere() noexcept {
  using namespace sphere_property;
  static const auto keys = std::to_array<JsonKey>({
      {.key = "origin",
       .type = JsonType::Triple,
       .presence = Presence::Required,
       .target = &sphere(),
       .property = kCenter},
      {.key = "radius",
       .type = JsonType::Number,
       .presence = Presence::Required,
       .target = &sphere(),
       .property = kRadius},
      {.key = "material",
       .type = JsonType::Material,
       .presence = Presence::Required,
       .target = &sphere(),
       .property = kMaterial,
       .doc = "What light does at the surface; its type decides the other keys."},
      {.key = "movement",
       .type = JsonType::Movement,
       .target = &sphere(),
       .property = kMotion,
       .doc = "[target, from, to]: at its origin at the time from, at the target at the time to, "
              "and on beyond both."},
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
  // `property` is here the index of the argument in the material's own table.
  static constexpr auto color = JsonKey{
      .key = "color", .type = JsonType::Color, .presence = Presence::Required, .property = 0};
  static constexpr auto plain = std::to_array<JsonKey>({color});
  static constexpr auto specular = std::to_array<JsonKey>(
      {color,
       {.key = "fuzz", .type = JsonType::Number, .presence = Presence::Required, .property = 1}});
  static constexpr auto transmissive = std::to_array<JsonKey>({color,
                                                               {.key = "refraction_index",
                                                                .type = JsonType::Number,
                                                                .presence = Presence::Required,
                                                                .property = 1}});
  static constexpr auto emissive = std::to_array<JsonKey>({color,
                                                           {.key = "intensity",
                                                            .type = JsonType::Number,
                                                            .presence = Presence::Required,
                                                            .property = 1}});
  switch (kind) {
    case MaterialKind::Specular: return specular;
    case MaterialKind::Transmissive: return transmissive;
    case MaterialKind::Emissive: return emissive;
    case MaterialKind::Diffuse:
    case MaterialKind::Unlit: break;
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
