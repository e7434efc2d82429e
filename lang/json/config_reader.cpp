#include "lang/json/config_reader.hpp"

#include <string>

#include <fmt/format.h>

#include "lang/json/json.hpp"

namespace sdlc::lang {
namespace {

std::string_view streamed_key() {
  for (const JsonKey& key : json_config().keys) {
    if (key.type == JsonType::Spheres) return key.key;
  }
  return "";
}

Object make_object(const SourceFile& file, ObjectKind kind) {
  Object object;
  object.kind = &kind_info(kind);
  object.where.file = &file;
  return object;
}

}  // namespace

ConfigReader::ConfigReader(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink)
    : file_(&file),
      objects_(&objects),
      sink_(&sink),
      values_(file, sink),
      materials_(file, sink),
      sphere_(make_object(file, ObjectKind::Sphere)),
      camera_(make_object(file, ObjectKind::Camera)),
      background_(make_object(file, ObjectKind::Background)),
      render_(make_object(file, ObjectKind::Render)) {}

void ConfigReader::begin(Span bracket) { bracket_ = bracket; }

void ConfigReader::take_element(const Tape& tape, std::uint32_t element) {
  // A text that is no list of spheres at all may have 10^8 elements.
  constexpr std::size_t kMaxErrors = 4'000'000;
  if (sink_->error_count() > kMaxErrors) return;
  const JsonObject& table = json_sphere();
  const JsonNode& node = tape[element];
  if (node.type != JsonNodeType::Object) {
    const std::string wanted = fmt::format("{} for each sphere", describe(JsonType::Object));
    values_.diagnose_type(streamed_key(), wanted, node);
    return;
  }

  const std::size_t errors = sink_->error_count();
  sphere_.where.span = {node.span.begin, node.span.begin + 1};
  const Members members = find_members(*file_, tape, element, table, *sink_);
  if (node.is_complete) check_required(*file_, tape, members, table, sphere_.where, *sink_);
  for (std::size_t row = 0; row < table.keys.size(); ++row) {
    const JsonKey& key = table.keys[row];
    Slot& slot = sphere_.slots[key.property];
    slot.is_written = has_value(tape, members, row);
    if (!slot.is_written) {
      slot.value = Nothing();
      continue;
    }
    const std::uint32_t value = members.value(row);
    slot.span = tape[value].span;
    slot.value = key.type == JsonType::Material
                     ? materials_.read(tape, value, at(tape[members.names[row]].content()))
                     : values_.read(key, key.target->properties[key.property].range, tape, value);
  }
  const bool is_good = node.is_complete && sink_->error_count() == errors;
  if (is_good) objects_->add(sphere_);
}

ConfigReader::Part& ConfigReader::part(std::string_view key) {
  return parts_[*find_key(json_config().keys, key)];
}

void ConfigReader::take_member(const Tape& tape) {
  if (tape[0].type == JsonNodeType::Error) return;  // no name, as has been reported
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

void ConfigReader::read_part(const JsonKey& key, const Tape& tape) {
  constexpr std::uint32_t kValue = 1;
  if (key.type == JsonType::Object) return read_object(key, tape);
  if (key.type != JsonType::Spheres) {
    const Range range = key.target->properties[key.property].range;
    return set(key, values_.read(key, range, tape, kValue), tape[kValue].span);
  }

  if (tape[kValue].type != JsonNodeType::Array) {
    return values_.diagnose_type(key.key, describe(key.type), tape[kValue]);
  }
  // Empty where the elements have been streamed; not where the key was written with escapes.
  for (std::uint32_t i = kValue + 1; i < tape[kValue].next; i = tape[i].next) take_element(tape, i);
}

void ConfigReader::read_object(const JsonKey& key, const Tape& tape) {
  constexpr std::uint32_t kObject = 1;
  const JsonObject& table = *key.object;
  if (tape[kObject].type != JsonNodeType::Object) {
    return values_.diagnose_type(key.key, describe(key.type), tape[kObject]);
  }

  const Members members = find_members(*file_, tape, kObject, table, *sink_);
  const Location where = at(tape[0].content());
  if (tape[kObject].is_complete) check_required(*file_, tape, members, table, where, *sink_);
  for (std::size_t row = 0; row < table.keys.size(); ++row) {
    if (!has_value(tape, members, row)) continue;
    const JsonKey& inner = table.keys[row];
    const std::uint32_t value = members.value(row);
    const Range range =
        inner.target != nullptr ? inner.target->properties[inner.property].range : inner.range;
    set(inner, values_.read(inner, range, tape, value), tape[value].span);
  }
}

void ConfigReader::set(const JsonKey& key, Value value, Span span) {
  Slot slot{.value = std::move(value), .span = span, .is_written = true};
  if (key.target != nullptr) {
    Object& object = key.target->id == ObjectKind::Camera       ? camera_
                     : key.target->id == ObjectKind::Background ? background_
                                                                : render_;
    object.slots[key.property] = std::move(slot);
    return;
  }
  switch (key.setting) {
    case JsonSetting::None: break;
    case JsonSetting::GammaCorrect: gamma_correct_ = std::move(slot); break;
    case JsonSetting::InParallel: in_parallel_ = std::move(slot); break;
    case JsonSetting::NumberCores: number_cores_ = std::move(slot); break;
  }
}

void ConfigReader::finish() {
  check_parts();
  set_tone();
  set_threads();

  const Part& image = part("image");
  const Part& rendering = part("rendering");
  const auto name_by = [](Object& object, const Part& part) { object.where.span = part.name; };
  name_by(camera_, part("camera"));
  name_by(background_, image.has_value ? image : part("background"));
  name_by(render_, image.has_value ? image : rendering);
  if (part("camera").has_value) objects_->add(camera_);
  if (background_.slot(background_property::kColor).is_written) objects_->add(background_);
  if (image.has_value || rendering.has_value) objects_->add(render_);
}

void ConfigReader::check_parts() {
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

void ConfigReader::check_plain_picture() {
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
  for (std::size_t i = 0; i < others.size(); ++i) {
    report.label(at(others[i]->name), "a plain picture has none");
  }
}

void ConfigReader::set_tone() {
  Slot& tone = render_.slots[render_property::kTone];
  tone = {.value = Word{"linear"}, .span = part("saving").value, .is_written = true};
  if (!gamma_correct_.is_written) return;
  tone.span = gamma_correct_.span;
  const auto* is_corrected = get_if<bool>(&gamma_correct_.value);
  if (is_corrected == nullptr) {
    tone.value = Nothing();
  } else if (*is_corrected) {
    tone.value = Word{"sqrt"};
  }
}

void ConfigReader::set_threads() {
  Slot& threads = render_.slots[render_property::kThreads];
  threads = number_cores_;
  const auto* is_parallel = get_if<bool>(&in_parallel_.value);
  const bool is_serial = is_parallel != nullptr && !*is_parallel;
  if (is_serial) threads = {.value = Scalar{1}, .span = in_parallel_.span, .is_written = true};
}

void read_config(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink) {
  constexpr std::size_t kLeastSphere = 64;  // bytes of its text
  objects.expect(file.text().size() / kLeastSphere);
  ConfigReader reader(file, objects, sink);
  if (parse_config(file, streamed_key(), reader, sink)) reader.finish();
}

void read_spheres(const SourceFile& file, ObjectSink& objects, DiagnosticSink& sink) {
  ConfigReader reader(file, objects, sink);
  parse_config(file, streamed_key(), reader, sink);
}

}  // namespace sdlc::lang
