#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/convert/config_number.hpp"
#include "lang/convert/writers.hpp"
#include "lang/schema/schema.hpp"
#include "render/image/tone.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kFrameMark = "####";
constexpr std::size_t kCopies = 3;  // that are made of the text in the end

std::string vector_text(render::Vec3 v) {
  return fmt::format("[{}, {}, {}]", config_number(v.x), config_number(v.y), config_number(v.z));
}

std::string interval_text(render::Interval interval) {
  return fmt::format("[{}, {}]", config_number(interval.from), config_number(interval.to));
}

std::string movement_text(render::Vec3 to, render::Interval over) {
  return fmt::format(", \"movement\": [{}, {}, {}]", vector_text(to), config_number(over.from),
                     config_number(over.to));
}

std::string string_text(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (static_cast<unsigned char>(c) < 0x20) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      result += c;
    }
  }
  return result + "\"";
}

std::string name_of_frame(std::string name, int frame) {
  for (std::size_t at = 0; (at = name.find(kFrameMark, at)) != std::string::npos;) {
    const std::string number = fmt::format("{:0{}}", frame, kFrameMark.size());
    name.replace(at, kFrameMark.size(), number);
    at += number.size();
  }
  return name;
}

/// Whether the format has no key of its own for the property, and yet it can be converted.
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
  // The very arithmetic of SceneBuilder: what is written are the numbers of the lowered scene.
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

std::string ConfigWriter::place_text(const Object& sphere) {
  using namespace sphere_property;
  const Object* viewer = camera();
  const auto shutter =
      viewer != nullptr ? viewer->get<render::Interval>(camera_property::kShutter) : std::nullopt;
  const auto center = *sphere.get<render::Vec3>(kCenter);
  const auto motion = sphere.get<MotionValue>(kMotion);
  const bool is_placed = !groups_.empty();
  if (motion && !is_placed) return vector_text(center) + movement_text(motion->to, motion->over);

  // A moving centre is joined linearly from the opening to the closing: a movement over the time
  // of the shutter.
  render::Vec3 opening = center, closing = *sphere.get_closing<render::Vec3>(kCenter);
  if (motion && shutter) {
    const render::Interval over = motion->over;
    const double duration = over.to - over.from;
    const render::Vec3 way = motion->to - center;
    opening = center + way * ((shutter->from - over.from) / duration);
    closing = opening + way * ((shutter->to - shutter->from) / duration);
  }
  bool is_moving = motion || !sphere.closing.empty();
  if (is_placed) {
    opening = groups_.back().placements[0].apply(opening);
    closing = groups_.back().placements[1].apply(closing);
    is_moving = is_moving || groups_.back().is_moving;
  }
  const bool is_seen_moving = is_moving && shutter && shutter->from != shutter->to;
  if (!is_seen_moving || opening == closing) return vector_text(opening);
  return vector_text(opening) + movement_text(closing, *shutter);
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
        .help("the format divides by 255, and no number gives this result; it is off by 2^-53");
  }
  return "[" + text + "]";
}

std::string ConfigWriter::material_text(const MaterialValue& material, Location where) {
  if (material.exact_fresnel) {
    sink_.report(diag::not_in_config, where, "`fresnel: exact`")
        .help("the format knows Schlick's approximation only");
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
  if (!center || !radius || !material) return;  // reported where it was read

  const double scale = groups_.empty() ? 1 : groups_.back().placements[0].scale;
  const std::string place = place_text(object);
  const std::size_t end = place.find(']') + 1;  // of the centre
  has_moving_spheres_ = has_moving_spheres_ || end < place.size();
  spheres_ +=
      fmt::format("{}\n    {{ \"origin\": {}, \"radius\": {}, \"material\": {}{} }}",
                  spheres_.empty() ? "" : ",", place.substr(0, end), config_number(*radius * scale),
                  material_text(*material, material_where), place.substr(end));
  bytes_.set(kCopies * spheres_.capacity());
}

std::optional<std::string> ConfigWriter::camera_text(const JsonKey& key,
                                                     const LoweredScene& lowered) {
  const Object& object = *camera();
  const auto text_of = [](const auto& value, auto to_text) {
    return value ? std::optional(to_text(*value)) : std::nullopt;
  };
  if (key.property == camera_property::kAspect) return config_number(lowered.scene.camera.aspect);
  if (key.type == JsonType::Triple) {
    return text_of(object.get<render::Vec3>(key.property), vector_text);
  }
  if (key.type == JsonType::Degrees) {
    return text_of(object.get<Angle>(key.property),
                   [](Angle angle) { return config_number(angle.degrees); });
  }
  if (key.type == JsonType::Interval) {
    return text_of(object.get<render::Interval>(key.property), interval_text);
  }
  return text_of(object.get<double>(key.property), config_number);
}

std::optional<std::string> ConfigWriter::render_text(const JsonKey& key,
                                                     const LoweredScene& lowered) {
  using namespace render_property;
  switch (key.property) {
    case kWidth: return std::to_string(lowered.settings.width);
    case kHeight: return std::to_string(lowered.settings.height);
    case kSamples: return std::to_string(lowered.settings.samples);
    case kDepth: return std::to_string(lowered.settings.depth);
    default: break;
  }
  if (key.type != JsonType::String || !render_ || !render_->slot(kOutput).is_written) return {};
  const std::string& output = lowered.output.output;
  return string_text(frame_ ? name_of_frame(output, *frame_) : output);
}

std::optional<std::string> ConfigWriter::setting_text(JsonSetting setting,
                                                      const LoweredScene& lowered) {
  const int threads = lowered.settings.threads;
  switch (setting) {
    case JsonSetting::GammaCorrect:
      return lowered.output.tone == render::Tone::Sqrt ? "true" : "false";
    case JsonSetting::InParallel: return threads == 1 ? "false" : "true";
    case JsonSetting::NumberCores:
      return threads > 1 ? std::optional(std::to_string(threads)) : std::nullopt;
    case JsonSetting::None: break;
  }
  return std::nullopt;
}

std::optional<std::string> ConfigWriter::background_text(const LoweredScene& lowered) {
  if (!background_) return std::nullopt;
  using namespace background_property;
  const render::Background &background = lowered.scene.background, usual;
  const std::size_t written = background_->slot(kColor).is_written ? kColor : kTop;
  const Location where = background_->location(written);
  if (background.is_constant()) return color_text(background.top, where);
  const bool is_usual = background.bottom == usual.bottom && background.top == usual.top;
  if (!is_usual) {
    sink_.report(diag::not_in_config, where, "a gradient of these colours")
        .help("the format has one gradient only, from white up to linear(0.5, 0.7, 1)");
  }
  return std::nullopt;
}

std::optional<std::string> ConfigWriter::value_text(const JsonKey& key,
                                                    const LoweredScene& lowered) {
  if (key.object != nullptr) return object_text(*key.object, lowered);
  if (key.type == JsonType::Spheres) {
    return spheres_.empty() ? std::nullopt : std::optional("[" + spheres_ + "\n  ]");
  }
  if (key.setting != JsonSetting::None) return setting_text(key.setting, lowered);
  // It has no effect, but the format wants it.
  if (key.target == nullptr) return "1";
  if (key.target->id == ObjectKind::Camera) return camera_text(key, lowered);
  if (key.target->id == ObjectKind::Render) return render_text(key, lowered);
  return background_text(lowered);
}

std::string ConfigWriter::object_text(const JsonObject& table, const LoweredScene& lowered) {
  std::vector<std::string> members;
  for (const JsonKey& key : table.keys) {
    if (const auto value = value_text(key, lowered)) {
      members.push_back(fmt::format("    \"{}\": {}", key.key, *value));
    }
  }
  return fmt::format("{{\n{}\n  }}", fmt::join(members, ",\n"));
}

void ConfigWriter::check_tone(const LoweredScene& lowered) {
  if (lowered.output.tone != render::Tone::Srgb) return;
  using namespace render_property;
  const bool is_written = render_ && render_->slot(kTone).is_written;
  const Location where = is_written ? render_->location(kTone)
                         : render_  ? render_->where
                                    : cameras_.front().where;
  sink_
      .report(diag::not_in_config, where,
              is_written ? "`tone: srgb`" : "`tone: srgb`, which holds where nothing is written,")
      .help("the format has `sqrt` and `linear`: `--tone sqrt` comes near");
}

void ConfigWriter::check_shutter() {
  const auto shutter = camera()->get<render::Interval>(camera_property::kShutter);
  if (!shutter || shutter->from <= shutter->to || !has_moving_spheres_) return;
  sink_
      .report(diag::not_in_config, camera()->location(camera_property::kShutter),
              "a shutter that closes before it opens")
      .help("the format has its two times in either order, and takes the earlier one first");
}

void ConfigWriter::check_height(const LoweredScene& lowered) {
  const render::RenderSettings& settings = lowered.settings;
  const double height = std::floor(settings.width / lowered.scene.camera.aspect);
  if (height == settings.height) return;
  sink_
      .report(diag::not_in_config, render_->location(render_property::kHeight),
              fmt::format("a height of {}", settings.height))
      .help(fmt::format("the format's height is width / aspect, rounded down: here {}", height));
}

std::string ConfigWriter::finish(const LoweredScene& lowered, std::optional<int> frame) {
  if (sink_.has_errors() && lowered.settings.width == 0) return {};  // there is no picture
  frame_ = frame;
  const bool is_plain = cameras_.empty();
  if (!is_plain && !lowered.camera) return {};
  if (!is_plain || render_) check_tone(lowered);
  if (!is_plain) {
    check_shutter();
    check_height(lowered);
  }
  std::vector<std::string> members;
  for (const JsonKey& key : json_config().keys) {
    const bool is_of_plain = key.key == "image";
    if (is_plain != is_of_plain && key.key != "saving") continue;
    if (const auto value = value_text(key, lowered)) {
      members.push_back(fmt::format("  \"{}\": {}", key.key, *value));
    }
  }
  return fmt::format("{{\n{}\n}}\n", fmt::join(members, ",\n"));
}

}  // namespace sdlc::lang
