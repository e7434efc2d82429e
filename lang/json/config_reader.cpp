#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "lang/json/json.hpp"
#include "lang/json/material_reader.hpp"
#include "lang/json/object_reader.hpp"
#include "lang/json/parser.hpp"
#include "lang/json/value_reader.hpp"

namespace sdlc::lang {
namespace {

Object make_object(const SourceFile& file, ObjectKind kind) {
  Object object;
  object.kind = &kind_info(kind);
  object.where.file = &file;
  return object;
}

/// Converts the parts of a config to objects, by the tables of keys.
class ConfigReader final : public ConfigParts {
 public:
  ConfigReader(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink)
      : file_(&file),
        objects_(&objects),
        sink_(&sink),
        values_(file, sink),
        materials_(file, sink),
        sphere_(make_object(file, ObjectKind::Sphere)),
        camera_(make_object(file, ObjectKind::Camera)),
        background_(make_object(file, ObjectKind::Background)),
        render_(make_object(file, ObjectKind::Render)) {}

  void begin(Span bracket) override { bracket_ = bracket; }
  void take_element(const Tape& tape, std::uint32_t element) override {
    const std::size_t errors = sink_->error_count();
    if (errors > kMaxConfigErrors) return;
    const JsonObject& table = json_sphere();
    const JsonNode& node = tape[element];
    if (node.type != JsonNodeType::Object) {
      const std::string wanted = fmt::format("{} for each sphere", describe(JsonType::Object));
      return values_.diagnose_type(streamed_key(), wanted, node);
    }

    sphere_.where.span = {node.span.begin, node.span.begin + 1};
    const Members members = find_members(*file_, tape, element, table, sphere_.where, *sink_);
    for (std::size_t row = 0; row < table.keys.size(); ++row) {
      const JsonKey& key = table.keys[row];
      Slot& slot = sphere_.slots[key.property];
      const std::uint32_t value = members.value(tape, row);
      slot.is_written = value != 0;
      if (!slot.is_written) {
        slot.value = Nothing();
        continue;
      }
      slot.span = tape[value].span;
      slot.value = key.type == JsonType::Material
                       ? materials_.read(tape, value, at(tape[members.names[row]].content()))
                       : values_.read(key, tape, value);
    }
    const bool is_good = node.is_complete && sink_->error_count() == errors;
    if (is_good) objects_->add(sphere_);
  }

  void take_member(const Tape& tape) override {
    if (tape[0].type == JsonNodeType::Error) return;  // a missing name, which has been reported
    const auto keys = json_config().keys;
    std::string buffer;
    const std::string_view name = member_name(*file_, tape[0], buffer);
    const Location where = at(tape[0].content());
    auto row = find_key(keys, name);
    const bool is_guess = !row;
    if (is_guess) row = diagnose_unknown_key(keys, json_config().name, name, where, *sink_);
    if (!row) return;

    Part& part = parts_[*row];
    if (part.is_given && !part.is_guess) {
      if (!is_guess) diagnose_duplicate_key(name, where, at(part.name), *sink_);
      return;
    }
    part = {.name = where.span,
            .value = tape[1].span,
            .is_given = true,
            .is_guess = is_guess,
            .has_value = tape[1].type != JsonNodeType::Null};
    if (part.has_value) read_part(keys[*row], tape);
  }

  /// Checks the config as a whole and passes on its camera, background and settings.
  void finish() {
    check_parts();
    set_tone();
    set_threads();

    const Part& image = part("image");
    const Part& rendering = part("rendering");
    camera_.where.span = part("camera").name;
    background_.where.span = image.has_value ? image.name : part("background").name;
    render_.where.span = image.has_value ? image.name : rendering.name;
    if (part("camera").has_value) objects_->add(camera_);
    if (background_.slot(background_property::kColor).is_written) objects_->add(background_);
    if (image.has_value || rendering.has_value) objects_->add(render_);
  }

 private:
  /// A member of the config that has been read.
  struct Part {
    Span name;
    Span value;
    bool is_given = false;
    bool is_guess = false;   ///< its key is misspelt
    bool has_value = false;  ///< it is not null
  };

  Location at(Span span) const { return {file_, span}; }
  Part& part(std::string_view key) { return parts_[*find_key(json_config().keys, key)]; }
  Slot& setting(JsonSetting setting) { return settings_[static_cast<std::size_t>(setting)]; }

  void read_part(const JsonKey& key, const Tape& tape) {
    constexpr std::uint32_t kValue = 1;
    const JsonNode& node = tape[kValue];
    if (key.type == JsonType::Object) return read_object(key, tape);
    if (key.type != JsonType::Spheres) return set(key, values_.read(key, tape, kValue), node.span);
    if (node.type != JsonNodeType::Array) {
      return values_.diagnose_type(key.key, describe(key.type), node);
    }
    // Empty after streaming; not if the key is misspelt.
    for (std::uint32_t i = kValue + 1; i < node.next; i = tape[i].next) take_element(tape, i);
  }

  void read_object(const JsonKey& key, const Tape& tape) {
    constexpr std::uint32_t kObject = 1;
    const JsonObject& table = *key.object;
    if (tape[kObject].type != JsonNodeType::Object) {
      return values_.diagnose_type(key.key, describe(key.type), tape[kObject]);
    }
    const Location where = at(tape[0].content());
    const Members members = find_members(*file_, tape, kObject, table, where, *sink_);
    for (std::size_t row = 0; row < table.keys.size(); ++row) {
      const std::uint32_t value = members.value(tape, row);
      const JsonKey& inner = table.keys[row];
      if (value != 0) set(inner, values_.read(inner, tape, value), tape[value].span);
    }
  }

  void set(const JsonKey& key, Value value, Span span) {
    const bool is_of_camera = key.target != nullptr && key.target->id == ObjectKind::Camera;
    const bool is_of_render = key.target != nullptr && key.target->id == ObjectKind::Render;
    Slot& slot = key.target == nullptr ? setting(key.setting)
                 : is_of_camera        ? camera_.slots[key.property]
                 : is_of_render        ? render_.slots[key.property]
                                       : background_.slots[key.property];
    slot = {.value = std::move(value), .span = span, .is_written = true};
  }

  void check_parts() {
    const bool is_plain_picture = part("image").has_value;
    if (is_plain_picture) check_plain_picture();
    const auto keys = json_config().keys;
    for (std::size_t row = 0; row < keys.size(); ++row) {
      const JsonKey& key = keys[row];
      const bool is_needed =
          key.presence == Presence::Required && (!is_plain_picture || key.key == "saving");
      if (!is_needed || parts_[row].has_value) continue;
      sink_->report(diag::missing, at(parts_[row].is_given ? parts_[row].value : bracket_),
                    json_config().name, key.key);
    }
  }

  void check_plain_picture() {
    std::vector<const Part*> others;
    std::vector<std::string> names;
    for (const std::string_view key : {"camera", "rendering", "spheres", "background"}) {
      if (!part(key).has_value) continue;
      others.push_back(&part(key));
      names.push_back(fmt::format("`{}`", key));
    }
    if (others.empty()) return;
    auto report = sink_->report(diag::not_together, at(part("image").name), "`image`",
                                fmt::format("{}", fmt::join(names, ", ")));
    for (const Part* other : others) report.label(at(other->name), "a plain picture has none");
  }

  void set_tone() {
    const Slot& gamma_correct = setting(JsonSetting::GammaCorrect);
    Slot& tone = render_.slots[render_property::kTone];
    tone = {.value = Word{"linear"}, .span = part("saving").value, .is_written = true};
    if (!gamma_correct.is_written) return;
    tone.span = gamma_correct.span;
    const auto* is_corrected = get_if<bool>(&gamma_correct.value);
    if (is_corrected == nullptr) {
      tone.value = Nothing();
    } else if (*is_corrected) {
      tone.value = Word{"sqrt"};
    }
  }

  void set_threads() {
    const Slot& in_parallel = setting(JsonSetting::InParallel);
    const auto* is_parallel = get_if<bool>(&in_parallel.value);
    const bool is_serial = is_parallel != nullptr && !*is_parallel;
    Slot& threads = render_.slots[render_property::kThreads];
    threads = setting(JsonSetting::NumberCores);
    if (is_serial) threads = {.value = Scalar{1}, .span = in_parallel.span, .is_written = true};
  }

  const SourceFile* file_;
  ObjectSink* objects_;
  DiagnosticSink* sink_;
  ValueReader values_;
  MaterialReader materials_;

  Span bracket_;
  std::array<Part, kMaxJsonKeys> parts_;
  Object sphere_, camera_, background_, render_;
  std::array<Slot, 4> settings_;  ///< by JsonSetting
};

}  // namespace

void read_config(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink) {
  constexpr std::size_t kMinSphereBytes = 64;
  objects.expect(file.text().size() / kMinSphereBytes);
  ConfigReader reader(file, objects, sink);
  if (parse_config(file, reader, sink)) reader.finish();
}

void read_spheres(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink) {
  ConfigReader reader(file, objects, sink);
  parse_config(file, reader, sink);
}

}  // namespace sdlc::lang
