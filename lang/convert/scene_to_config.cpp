#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "lang/convert/config_number.hpp"
#include "lang/convert/writers.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

constexpr std::size_t kCopies = 3;  // of the text of the spheres, in finish() and its caller

/// Whether the property can be converted although the format has no key for it.
bool is_converted_otherwise(const Object& object, std::size_t property) {
  switch (object.kind->id) {
    case ObjectKind::Render:
      return property == render_property::kTone || property == render_property::kCamera ||
             property == render_property::kThreads;
    case ObjectKind::Background:
      return property == background_property::kBottom || property == background_property::kTop;
    default: return false;
  }
}

bool is_default(const Property& property, const Value& value) {
  const auto number = value_as<double>(value);
  const auto* usual = std::get_if<double>(&property.default_value);
  if (number && usual != nullptr) return *number == *usual;
  const auto* word = get_if<Word>(&value);
  const auto* usual_word = std::get_if<std::string_view>(&property.default_value);
  return word != nullptr && usual_word != nullptr && word->text == *usual_word;
}

}  // namespace

void ConfigWriter::add(const Object& object) {
  next_.add(object);
  switch (object.kind->id) {
    case ObjectKind::Camera: cameras_.push_back(object); break;
    case ObjectKind::Background: background_ = object; break;
    case ObjectKind::Render: render_ = object; break;
    case ObjectKind::Sphere: add_sphere(object); break;
    case ObjectKind::Animation:
    case ObjectKind::Group: break;
  }
  const bool is_setting = object.kind->is_setting && object.kind->id != ObjectKind::Animation;
  if (is_setting) diagnose_foreign_properties(object);
}

void ConfigWriter::diagnose_foreign_properties(const Object& object) {
  const auto properties = object.kind->properties;
  for (std::size_t i = 0; i < properties.size(); ++i) {
    const Slot& slot = object.slot(i);
    if (!slot.is_written || !json_key_of(*object.kind, i).empty()) continue;
    if (is_converted_otherwise(object, i) || is_default(properties[i], slot.value)) continue;
    sink_.report(diag::not_in_config, object.location(i), fmt::format("`{}`", properties[i].name))
        .help("the format has no key for it");
  }
}

void ConfigWriter::enter(const Object& object) {
  next_.enter(object);
  using namespace group_property;
  // The same arithmetic as in SceneBuilder, so that the numbers are those of the lowered scene.
  const double scale = object.get<double>(kScale).value_or(1);
  const auto placement = [&](auto translate, auto rotate) {
    return placement_of(translate.value_or(render::Vec3{}), rotate.value_or(AngleTriple{}).degrees,
                        scale);
  };
  Group group{.placements = {placement(object.get<render::Vec3>(kTranslate),
                                       object.get<AngleTriple>(kRotate)),
                             placement(object.get_closing<render::Vec3>(kTranslate),
                                       object.get_closing<AngleTriple>(kRotate))},
              .is_moving = !object.closing.empty(),
              .material = object.get<MaterialValue>(kMaterial),
              .material_where = object.location(kMaterial)};
  if (!groups_.empty()) {
    const Group& outer = groups_.back();
    for (std::size_t i = 0; i < 2; ++i) {
      group.placements[i] = outer.placements[i].around(group.placements[i]);
    }
    group.is_moving = group.is_moving || outer.is_moving;
    if (!group.material) {
      group.material = outer.material;
      group.material_where = outer.material_where;
    }
  }
  groups_.push_back(std::move(group));
}

void ConfigWriter::leave() {
  next_.leave();
  groups_.pop_back();
}

const Object* ConfigWriter::camera() const {
  if (cameras_.empty()) return nullptr;
  std::optional<std::string> wanted = chosen_camera_;
  if (!wanted && render_) {
    if (const auto word = render_->get<Word>(render_property::kCamera)) wanted = word->text;
  }
  const auto found = std::ranges::find(cameras_, wanted.value_or(""), &Object::name);
  return wanted && found != cameras_.end() ? &*found : &cameras_.front();
}

ConfigWriter::Place ConfigWriter::place_of(const Object& sphere) {
  using namespace sphere_property;
  const auto movement = [](render::Vec3 to, render::Interval over) {
    return fmt::format(", \"movement\": [{}, {}, {}]", vector_text(to), config_number(over.from),
                       config_number(over.to));
  };
  const Object* viewer = camera();
  const auto shutter =
      viewer != nullptr ? viewer->get<render::Interval>(camera_property::kShutter) : std::nullopt;
  const auto center = *sphere.get<render::Vec3>(kCenter);
  const auto motion = sphere.get<MotionValue>(kMotion);
  const Group* group = groups_.empty() ? nullptr : &groups_.back();
  if (motion && group == nullptr) return {vector_text(center), movement(motion->to, motion->over)};

  // The centre moves linearly from its place at the opening to that at the closing: a movement over
  // the time of the shutter.
  render::Vec3 opening = center, closing = *sphere.get_closing<render::Vec3>(kCenter);
  if (motion && shutter) {
    const render::Interval over = motion->over;
    const double duration = over.to - over.from;
    const render::Vec3 way = motion->to - center;
    opening = center + way * ((shutter->from - over.from) / duration);
    closing = opening + way * ((shutter->to - shutter->from) / duration);
  }
  bool is_moving = motion || !sphere.closing.empty();
  if (group != nullptr) {
    opening = group->placements[0].apply(opening);
    closing = group->placements[1].apply(closing);
    is_moving = is_moving || group->is_moving;
  }
  const bool is_seen_moving = is_moving && shutter && shutter->from != shutter->to;
  if (!is_seen_moving || opening == closing) return {vector_text(opening), ""};
  return {vector_text(opening), movement(closing, *shutter)};
}

std::string ConfigWriter::color_text(render::LinearRgb color, Location where) {
  std::string text;
  bool is_exact = true;
  for (const double component : {color.r, color.g, color.b}) {
    const ScaledComponent scaled = to_config_scale(component, preferred_);
    if (!std::isfinite(scaled.number)) {
      sink_.report(diag::not_in_config, where, "a colour as bright as this");
      return {};
    }
    is_exact = is_exact && scaled.is_exact;
    text += (text.empty() ? "" : ", ") + config_number(scaled.number);
  }
  if (!is_exact) {
    has_rounded_colors_ = true;
    sink_.report(diag::rounded_color, where)
        .help("the format divides by 255, and no number gives this result; the error is 2^-53");
  }
  return "[" + text + "]";
}

std::string ConfigWriter::material_text(const MaterialValue& material, Location where) {
  if (material.exact_fresnel) {
    sink_.report(diag::not_in_config, where, "`fresnel: exact`")
        .help("the format has Schlick's approximation only");
  }
  const MaterialInfo& info = material_info(material.kind);
  std::string text = fmt::format("{{ \"type\": \"{}\"", info.json_name);
  for (const JsonKey& key : json_material_keys(material.kind)) {
    text += fmt::format(", \"{}\": {}", key.key,
                        key.type == JsonType::Color ? color_text(material.color, where)
                                                    : config_number(material.parameter));
  }
  return text + " }";
}

void ConfigWriter::add_sphere(const Object& object) {
  using namespace sphere_property;
  const auto center = object.get<render::Vec3>(kCenter);
  const auto radius = object.get<double>(kRadius);
  auto material = object.get<MaterialValue>(kMaterial);
  Location material_where = object.location(kMaterial);
  const bool inherits = !object.slot(kMaterial).is_written && !groups_.empty();
  if (inherits) {
    material = groups_.back().material;
    material_where = groups_.back().material_where;
  }
  if (!center || !radius || !material) return;  // has been reported

  const double scale = groups_.empty() ? 1 : groups_.back().placements[0].scale;
  const Place place = place_of(object);
  has_moving_spheres_ = has_moving_spheres_ || !place.movement.empty();
  spheres_ += fmt::format("{}\n    {{ \"origin\": {}, \"radius\": {}, \"material\": {}{} }}",
                          spheres_.empty() ? "" : ",", place.center, config_number(*radius * scale),
                          material_text(*material, material_where), place.movement);
  bytes_.set(kCopies * spheres_.capacity());
}

}  // namespace sdlc::lang
