#include <algorithm>
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

constexpr std::uint32_t kValue = 1;  // of a member on its tape

std::string_view streamed_key() {
  const auto keys = json_config().keys;
  return std::ranges::find(keys, JsonType::Spheres, &JsonKey::type)->key;
}

std::string interval_text(const ConfigValue& from, const ConfigValue& to) {
  return fmt::format("{}s .. {}s", from.spelling(), to.spelling());
}

/// A config takes the two times in either order; they are written in theirs.
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

/// Writes a config in which no mistake has been found, part by part.
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
        drop(text, key, *member, "without `time_interval` every sphere stays at its origin");
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
    if (key.type == JsonType::Object) {
      take_object(key, value);
    } else if (key.type == JsonType::Spheres) {
      // Empty, unless the key is written with escapes, so that they were not streamed.
      for (std::uint32_t i = kValue + 1; i < tape[kValue].next; i = tape[i].next) {
        take_element(tape, i);
      }
    } else {
      put(key, value);
    }
  }

  std::size_t forced_warnings() const noexcept { return forced_warnings_; }

  std::string finish() {
    add_tone();
    add_threads();
    std::string text = "scene 1\n";
    std::string declarations;
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
    // What makes a file a plain picture is that it has a width of its own.
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
        setting(key.setting) = remember(*member);
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

  /// Keeps a key without effect as a comment.
  void drop(ObjectText& object, const JsonKey& key, const ConfigMember& member,
            std::string_view reason) {
    object.add_comment(fmt::format("{}: {} had no effect", key.key, member.value.on_one_line()));
    sink_->report(diag::no_effect, member.name, key.key)
        .help(fmt::format("{}; the scene keeps it as a comment", reason));
  }

  /// What is kept of a member until all are known: its tape does not last so long.
  struct Setting {
    bool is_given = false;
    double value = 0;
    std::string spelling;
    Location name;
  };

  static Setting remember(const ConfigMember& member) {
    return {.is_given = true,
            .value = member.value.number(),
            .spelling = std::string(member.value.spelling()),
            .name = member.name};
  }

  Setting& setting(JsonSetting which) {
    return which == JsonSetting::GammaCorrect ? gamma_correct_
           : which == JsonSetting::InParallel ? in_parallel_
                                              : number_cores_;
  }

  void add_tone() {
    using namespace render_property;
    const bool is_corrected = gamma_correct_.is_given && gamma_correct_.value != 0;
    render_.add(kTone, "tone", is_corrected ? "sqrt" : "linear");
  }

  void add_threads() {
    using namespace render_property;
    const bool is_serial = in_parallel_.is_given && in_parallel_.value == 0;
    if (is_serial) {
      render_.add(kThreads, "threads", "1");
      if (!number_cores_.is_given) return;
      render_.add_comment(fmt::format("number_cores: {} had no effect", number_cores_.spelling));
      sink_->report(diag::no_effect, number_cores_.name, "number_cores")
          .help("`in_parallel` is false; the scene keeps it as a comment");
    } else if (number_cores_.is_given && number_cores_.value != 0) {
      render_.add(kThreads, "threads", number_cores_.spelling);
    }
  }

  const SourceFile* file_;
  const ConfigFacts* facts_;
  DiagnosticSink* sink_;
  ObjectText camera_{"camera main"}, background_{"background"}, render_{"render"};
  std::string spheres_;
  Setting gamma_correct_, in_parallel_, number_cores_;
  std::size_t forced_warnings_ = 0;
};

}  // namespace

std::string write_scene(const SourceFile& config, DiagnosticSink& sink,
                        std::size_t& forced_warnings) {
  DiagnosticSink silent;  // what there is to say has been said
  ConfigFacts facts(config);
  parse_config(config, streamed_key(), facts, silent);
  facts.finish();
  SceneWriter writer(config, facts, sink);
  parse_config(config, streamed_key(), writer, silent);
  forced_warnings += writer.forced_warnings();
  return writer.finish();
}

}  // namespace sdlc::lang
