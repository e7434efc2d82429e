#include "lang/json/material_reader.hpp"

#include <fmt/format.h>

#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

constexpr JsonKey kType{.key = "type", .type = JsonType::String, .presence = Presence::Required};
constexpr std::size_t kTypeRow = 0;

std::optional<MaterialKind> kind_of(std::string_view type) {
  for (const MaterialInfo& info : all_materials()) {
    if (info.json_name == type) return info.id;
  }
  return std::nullopt;
}

}  // namespace

MaterialReader::MaterialReader(const SourceFile& file, DiagnosticSink& sink)
    : file_(&file), sink_(&sink), values_(file, sink) {
  any_kind_ = {.name = "a material", .keys = {kType}};
  for (const MaterialInfo& info : all_materials()) {
    const bool has_vowel =
        std::string_view("aeiou").find(info.json_name[0]) != std::string_view::npos;
    Table& table = kinds_.emplace_back();
    table = {.name = fmt::format("{} {} material", has_vowel ? "an" : "a", info.json_name),
             .keys = {kType}};
    table.add_keys(info.id);
    any_kind_.add_keys(info.id);
  }
  for (JsonKey& key : any_kind_.keys) key.presence = Presence::Optional;
}

void MaterialReader::Table::add_keys(MaterialKind kind) {
  for (const JsonKey& key : json_material_keys(kind)) {
    if (!find_key(keys, key.key)) keys.push_back(key);
  }
}

Value MaterialReader::read(const Tape& tape, std::uint32_t node, Location where) {
  if (tape[node].type != JsonNodeType::Object) {
    values_.diagnose_type("material", describe(JsonType::Material), tape[node]);
    return {};
  }

  const auto kind = read_kind(tape, node, where);
  const Table& table = kind ? kinds_[static_cast<std::size_t>(*kind)] : any_kind_;
  const JsonObject object{.name = table.name, .keys = table.keys};
  const Members members = find_members(*file_, tape, node, object, where, *sink_);

  MaterialValue material;
  material.kind = kind.value_or(MaterialKind::Diffuse);
  bool is_good = kind.has_value() && tape[node].is_complete;
  for (std::size_t row = kTypeRow + 1; row < table.keys.size(); ++row) {
    const JsonKey& key = table.keys[row];
    const std::uint32_t index = members.value(tape, row);
    if (index == 0) {
      is_good &= key.presence == Presence::Optional;
      continue;
    }
    const Value value = values_.read(key, tape, index);
    if (const auto* color = get_if<render::LinearRgb>(&value)) {
      material.color = *color;
    } else if (const auto* parameter = get_if<Scalar>(&value)) {
      material.parameter = parameter->value;
    } else {
      is_good = false;
    }
  }
  return is_good ? Value(material) : Value();
}

std::optional<MaterialKind> MaterialReader::read_kind(const Tape& tape, std::uint32_t node,
                                                      Location where) {
  std::string buffer;
  const std::uint32_t end = tape[node].next;
  for (std::uint32_t i = node + 1; i + 1 < end; i = tape[i + 1].next) {
    if (tape[i].type == JsonNodeType::Error) continue;
    if (member_name(*file_, tape[i], buffer) == kType.key) return read_type(tape, i + 1);
  }
  if (tape[node].is_complete) sink_->report(diag::missing, where, "the material", kType.key);
  return std::nullopt;
}

std::optional<MaterialKind> MaterialReader::read_type(const Tape& tape, std::uint32_t type) {
  if (tape[type].type == JsonNodeType::Null) {
    sink_->report(diag::missing, {file_, tape[type].span}, "the material", kType.key);
    return std::nullopt;
  }
  const JsonNode& node = tape[type];
  if (node.type == JsonNodeType::String && !node.has_escapes) {
    if (const auto kind = kind_of(file_->text(node.content()))) return kind;
  }
  const auto name = values_.read_string(kType.key, tape, type);
  if (!name) return std::nullopt;
  if (const auto kind = kind_of(*name)) return kind;

  std::vector<std::string_view> names;
  for (const MaterialInfo& info : all_materials()) names.push_back(info.json_name);
  sink_->report(diag::unknown_word, {file_, node.content()}, abbreviated(*name), kType.key)
      .suggest(nearest_name(*name, names))
      .help(fmt::format("it takes {}", fmt::join(names, ", ")));
  return std::nullopt;
}

}  // namespace sdlc::lang
