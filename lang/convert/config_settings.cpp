#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "lang/convert/config_number.hpp"
#include "lang/convert/writers.hpp"
#include "lang/schema/schema.hpp"
#include "lang/text/replace_all.hpp"
#include "render/image/tone.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kFrameMark = "####";

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
  return lang::replace_all(std::move(name), kFrameMark,
                           fmt::format("{:0{}}", frame, kFrameMark.size()));
}

std::string config_text(double number) { return config_number(number); }
std::string config_text(render::Vec3 vector) { return vector_text(vector); }
std::string config_text(Angle angle) { return config_number(angle.degrees); }
std::string config_text(render::Interval interval) {
  return fmt::format("[{}, {}]", config_number(interval.from), config_number(interval.to));
}

template <typename T>
std::optional<std::string> text_of(const Object& object, std::size_t property) {
  const auto value = object.get<T>(property);
  return value ? std::optional(config_text(*value)) : std::nullopt;
}

}  // namespace

std::string vector_text(render::Vec3 v) {
  return fmt::format("[{}, {}, {}]", config_number(v.x), config_number(v.y), config_number(v.z));
}

std::optional<std::string> ConfigWriter::camera_text(const JsonKey& key) {
  const Object& object = *camera();
  if (key.property == camera_property::kAspect) return config_text(lowered_->scene.camera.aspect);
  switch (key.type) {
    case JsonType::Triple: return text_of<render::Vec3>(object, key.property);
    case JsonType::Degrees: return text_of<Angle>(object, key.property);
    case JsonType::Interval: return text_of<render::Interval>(object, key.property);
    default: return text_of<double>(object, key.property);
  }
}

std::optional<std::string> ConfigWriter::render_text(const JsonKey& key) {
  using namespace render_property;
  switch (key.property) {
    case kWidth: return std::to_string(lowered_->settings.width);
    case kHeight: return std::to_string(lowered_->settings.height);
    case kSamples: return std::to_string(lowered_->settings.samples);
    case kDepth: return std::to_string(lowered_->settings.depth);
    default: break;
  }
  if (!render_ || !render_->slot(kOutput).is_written) return std::nullopt;
  const std::string& output = lowered_->output.output;
  return string_text(frame_ ? name_of_frame(output, *frame_) : output);
}

std::optional<std::string> ConfigWriter::setting_text(JsonSetting setting) {
  const int threads = lowered_->settings.threads;
  switch (setting) {
    case JsonSetting::GammaCorrect:
      return lowered_->output.mapping.tone == render::Tone::Sqrt ? "true" : "false";
    case JsonSetting::InParallel: return threads == 1 ? "false" : "true";
    case JsonSetting::NumberCores:
      return threads > 1 ? std::optional(std::to_string(threads)) : std::nullopt;
    case JsonSetting::None: break;
  }
  return "1";  // a required key without effect
}

std::optional<std::string> ConfigWriter::background_text() {
  if (!background_) return std::nullopt;
  using namespace background_property;
  const render::Background &background = lowered_->scene.background, usual;
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

std::optional<std::string> ConfigWriter::value_text(const JsonKey& key) {
  if (key.object != nullptr) return object_text(*key.object, "  ");
  if (key.type == JsonType::Spheres) {
    return spheres_.empty() ? std::nullopt : std::optional("[" + spheres_ + "\n  ]");
  }
  if (key.target == nullptr) return setting_text(key.setting);
  if (key.target->id == ObjectKind::Camera) return camera_text(key);
  if (key.target->id == ObjectKind::Render) return render_text(key);
  return background_text();
}

std::string ConfigWriter::object_text(const JsonObject& table, std::string_view indent) {
  const bool is_plain = cameras_.empty();
  std::vector<std::string> members;
  for (const JsonKey& key : table.keys) {
    const bool is_of_other_form = is_plain != (key.key == "image") && key.key != "saving";
    if (&table == &json_config() && is_of_other_form) continue;
    if (const auto value = value_text(key)) {
      members.push_back(fmt::format("{}  \"{}\": {}", indent, key.key, *value));
    }
  }
  return fmt::format("{{\n{}\n{}}}", fmt::join(members, ",\n"), indent);
}

void ConfigWriter::check_tone() {
  const render::Tone tone = lowered_->output.mapping.tone;
  if (tone == render::Tone::Sqrt || tone == render::Tone::Linear) return;
  using namespace render_property;
  const bool is_written = render_ && render_->slot(kTone).is_written;
  const Location where = is_written ? render_->location(kTone)
                         : render_  ? render_->where
                                    : cameras_.front().where;
  sink_
      .report(diag::not_in_config, where,
              fmt::format("`tone: {}`{}", name_of(tone), is_written ? "" : ", the default,"))
      .help("the format has `sqrt` and `linear`: `--tone sqrt` is similar");
}

void ConfigWriter::check_shutter() {
  const auto shutter = camera()->get<render::Interval>(camera_property::kShutter);
  if (!shutter || shutter->from <= shutter->to || !has_moving_spheres_) return;
  sink_
      .report(diag::not_in_config, camera()->location(camera_property::kShutter),
              "a shutter that closes before it opens")
      .help("the format accepts its two times in either order and begins at the earlier one");
}

void ConfigWriter::check_height() {
  const render::RenderSettings& settings = lowered_->settings;
  const double height = std::floor(settings.width / lowered_->scene.camera.aspect);
  if (height == settings.height) return;
  sink_
      .report(diag::not_in_config, render_->location(render_property::kHeight),
              fmt::format("a height of {}", settings.height))
      .help(fmt::format("the format's height is width / aspect, rounded down: here {}", height));
}

std::string ConfigWriter::finish(const LoweredScene& lowered, std::optional<int> frame) {
  if (sink_.has_errors() && lowered.settings.width == 0) return {};  // there is no picture
  lowered_ = &lowered;
  frame_ = frame;
  const bool is_plain = cameras_.empty();
  if (!is_plain && !lowered.camera) return {};
  if (!is_plain || render_) check_tone();
  if (!is_plain) {
    check_shutter();
    check_height();
  }
  return object_text(json_config(), "") + "\n";
}

}  // namespace sdlc::lang
