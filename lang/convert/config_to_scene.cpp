#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "lang/convert/config_facts.hpp"
#include "lang/convert/config_value.hpp"
#include "lang/convert/scene_text.hpp"
#include "lang/convert/writers.hpp"
#include "lang/json/json.hpp"
#include "lang/json/object_reader.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

constexpr std::uint32_t kValue = 1;  // the tape index of a member's value

std::string interval_text(const ConfigValue& from, const ConfigValue& to) {
  return fmt::format("{}s .. {}s", from.spelling(), to.spelling());
}

/// A config accepts the two times in either order; the language needs them ascending.
std::string shutter_text(const ConfigValue& interval) {
  const auto ends = interval.elements();
  const bool is_backwards = ends[1].number() < ends[0].number();
  return interval_text(ends[is_backwards ? 1 : 0], ends[is_backwards ? 0 : 1]);
}

std::string motion_text(const ConfigValue& movement) {
  const auto parts = movement.elements();
  return fmt::format("line(to: {}, over: {})", triple_text(parts[0]),
                     interval_text(parts[1], parts[2]));
}

std::string value_text(JsonType type, const ConfigValue& value) {
  switch (type) {
    case JsonType::String: return scene_string(value.string());
    case JsonType::Triple: return triple_text(value);
    case JsonType::Color: return color_text(value);
    case JsonType::Degrees: return std::string(value.spelling()) + "deg";
    case JsonType::Interval: return shutter_text(value);
    case JsonType::Movement: return motion_text(value);
    case JsonType::Number:
    case JsonType::WholeNumber:
    case JsonType::Bool:
    case JsonType::Object:
    case JsonType::Material:
    case JsonType::Spheres: break;
  }
  return std::string(value.spelling());
}

/// Second pass over a config: writes the scene part by part.
class SceneWriter final : public ConfigParts {
 public:
  SceneWriter(const SourceFile& file, const ConfigFacts& facts, DiagnosticSink& sink)
      : file_(&file), facts_(&facts), sink_(&sink) {}

  void begin(Span /*bracket*/) override {}

  void take_element(const Tape& tape, std::uint32_t element) override {
    const ConfigValue sphere(*file_, tape, element);
    const ConfigMaterial& material = facts_->material_of(sphere.find("material")->value);
    ObjectText text("sphere");
    for (const JsonKey& key : json_sphere().keys) {
      const auto member = sphere.find(key.key);
      if (!member) continue;
      const Property& property = key.target->properties[key.property];
      if (key.type == JsonType::Material) {
        text.add(key.property, property.name,
                 material.name.empty() ? material.text : material.name);
      } else if (key.type == JsonType::Movement && !facts_->has_shutter()) {
        drop(text, key, *member, "without `time_interval` no sphere moves");
      } else if (key.key == "radius" && member->value.spelling() == material.radius.spelling) {
        text.add(key.property, property.name, material.radius.name);
      } else {
        text.add(key.property, property.name, value_text(key.type, member->value));
      }
    }
    spheres_ += text.str();
  }

  void take_member(const Tape& tape) override {
    if (tape[kValue].type == JsonNodeType::Null) return;
    std::string buffer;
    const auto keys = json_config().keys;
    const JsonKey& key = keys[*find_key(keys, member_name(*file_, tape[0], buffer))];
    const ConfigValue value(*file_, tape, kValue);
    if (key.type == JsonType::Object) return take_object(key, value);
    if (key.type != JsonType::Spheres) put(key, value);  // spheres come as elements
  }

  std::size_t forced_warnings() const noexcept { return forced_warnings_; }

  std::string finish() {
    add_tone();
    add_threads();
    std::string text = "scene 1\n", declarations;
    for (const ConfigMaterial& material : facts_->materials()) {
      if (material.name.empty()) continue;
      declarations += fmt::format("let {} = {}\n", material.name, material.text);
      if (material.radius.name.empty()) continue;
      declarations += fmt::format("let {} = {}\n", material.radius.name, material.radius.spelling);
    }
    for (const std::string& section :
         {declarations, camera_.is_empty() ? "" : camera_.str(),
          background_.is_empty() ? "" : background_.str(), spheres_, render_.str()}) {
      if (!section.empty()) text += "\n" + section;
    }
    return text;
  }

 private:
  void take_object(const JsonKey& part, const ConfigValue& object) {
    // A written width makes a file without camera a plain picture.
    const bool keeps_defaults = part.key == "image";
    for (const JsonKey& key : part.object->keys) {
      const auto member = object.find(key.key);
      if (!member) continue;
      if (key.target != nullptr) {
        put(key, member->value, keeps_defaults);
      } else if (key.setting == JsonSetting::None) {
        drop(camera_, key, *member, "everything is in focus");
        if (key.presence == Presence::Required) ++forced_warnings_;
      } else {
        setting(key.setting) = {.is_given = true,
                                .value = member->value.number(),
                                .spelling = std::string(member->value.spelling()),
                                .name = member->name};
      }
    }
  }

  ObjectText& object_of(const Kind& kind) {
    return kind.id == ObjectKind::Camera       ? camera_
           : kind.id == ObjectKind::Background ? background_
                                               : render_;
  }

  void put(const JsonKey& key, const ConfigValue& value, bool keeps_defaults = false) {
    const Property& property = key.target->properties[key.property];
    if (!keeps_defaults && is_default(property, key, value)) return;
    object_of(*key.target).add(key.property, property.name, value_text(key.type, value));
  }

  /// Writes a key without effect as a comment.
  void drop(ObjectText& object, const JsonKey& key, const ConfigMember& member,
            std::string_view reason) {
    object.add_comment(fmt::format("{}: {} had no effect", key.key, member.value.on_one_line()));
    sink_->report(diag::no_effect, member.name, key.key)
        .help(fmt::format("{}; the scene keeps it as a comment", reason));
  }

  /// A copy of a member, which outlives its tape.
  struct Setting {
    bool is_given = false;
    double value = 0;
    std::string spelling;
    Location name;
  };

  Setting& setting(JsonSetting setting) { return settings_[static_cast<std::size_t>(setting)]; }

  void add_tone() {
    const bool is_corrected = setting(JsonSetting::GammaCorrect).value != 0;
    render_.add(render_property::kTone, "tone", is_corrected ? "sqrt" : "linear");
  }

  void add_threads() {
    using namespace render_property;
    const Setting& in_parallel = setting(JsonSetting::InParallel);
    const Setting& cores = setting(JsonSetting::NumberCores);
    if (in_parallel.is_given && in_parallel.value == 0) {
      render_.add(kThreads, "threads", "1");
      if (!cores.is_given) return;
      render_.add_comment(fmt::format("number_cores: {} had no effect", cores.spelling));
      sink_->report(diag::no_effect, cores.name, "number_cores")
          .help("`in_parallel` is false; the scene keeps it as a comment");
    } else if (cores.value != 0) {
      render_.add(kThreads, "threads", cores.spelling);
    }
  }

  const SourceFile* file_;
  const ConfigFacts* facts_;
  DiagnosticSink* sink_;
  ObjectText camera_{"camera main"}, background_{"background"}, render_{"render"};
  std::string spheres_;
  std::array<Setting, 4> settings_;  ///< by JsonSetting
  std::size_t forced_warnings_ = 0;
};

}  // namespace

std::string write_scene(const SourceFile& config, DiagnosticSink& sink,
                        std::size_t& forced_warnings) {
  DiagnosticSink silent;  // the config has been checked
  ConfigFacts facts(config);
  parse_config(config, facts, silent);
  facts.finish();
  SceneWriter writer(config, facts, sink);
  parse_config(config, writer, silent);
  forced_warnings += writer.forced_warnings();
  return writer.finish();
}

}  // namespace sdlc::lang
