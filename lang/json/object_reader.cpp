#include "lang/json/object_reader.hpp"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "lang/repair/habits.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {

namespace {

/// Whether the name is that of the key's property in the language, or a habitual name of it.
bool is_called(const JsonKey& key, std::string_view name) {
  if (key.target != nullptr) {
    const std::string_view property = key.target->properties[key.property].name;
    const auto habit = property_habit(*key.target, name);
    return property == name || (habit && habit->meant == property);
  }
  const bool is_argument =
      key.object == nullptr && key.setting == JsonSetting::None && key.type != JsonType::Spheres;
  if (!is_argument) return false;
  const auto own_habit = find_habit(HabitPlace::Argument, key.key);
  const std::string_view argument = own_habit ? own_habit->meant : key.key;
  const auto habit = find_habit(HabitPlace::Argument, name);
  return argument == name || (habit && habit->meant == argument);
}

std::optional<std::string_view> key_by_habit(std::span<const JsonKey> keys, std::string_view name) {
  for (const JsonKey& key : keys) {
    if (is_called(key, name)) return key.key;
  }
  return std::nullopt;
}

bool is_key_of_material(std::string_view name) {
  if (name == "type") return true;
  return std::ranges::any_of(all_materials(), [&](const MaterialInfo& info) {
    return find_key(json_material_keys(info.id), name).has_value();
  });
}

/// The name in messages of a nested object that has the key; empty: none.
std::string_view find_home(std::span<const JsonKey> keys, std::string_view name) {
  for (const JsonKey& key : keys) {
    if (key.type == JsonType::Material && is_key_of_material(name)) return "the material";
    const JsonObject* inside = key.type == JsonType::Spheres ? &json_sphere() : key.object;
    if (inside == nullptr) continue;
    if (find_key(inside->keys, name)) return inside->name;
    if (const auto home = find_home(inside->keys, name); !home.empty()) return home;
  }
  return {};
}

/// The object that the key belongs to, in words; empty: none. `keys`: of the object that has it.
std::string describe_home(std::span<const JsonKey> keys, std::string_view name) {
  if (find_key(keys, "type")) {
    const auto kind = std::ranges::find_if(all_materials(), [&](const MaterialInfo& info) {
      return find_key(json_material_keys(info.id), name).has_value();
    });
    if (kind != all_materials().end()) return fmt::format("{} materials have one", kind->json_name);
  }
  std::string_view home = find_home(keys, name);
  if (home.empty() && find_key(json_config().keys, name)) home = json_config().name;
  if (home.empty()) home = find_home(json_config().keys, name);
  return home.empty() ? "" : fmt::format("it belongs in {}", home);
}

}  // namespace

std::optional<std::size_t> diagnose_unknown_key(std::span<const JsonKey> keys,
                                                std::string_view object, std::string_view name,
                                                Location where, DiagnosticSink& sink) {
  std::vector<std::string_view> names;
  for (const JsonKey& key : keys) names.push_back(key.key);
  auto meant = key_by_habit(keys, name);
  const std::string home = meant ? "" : describe_home(keys, name);
  if (!meant && home.empty()) meant = nearest_name(name, names);
  auto report = sink.report(diag::unknown_key, where, abbreviated(name), object);
  report.suggest(meant);
  if (!home.empty()) report.help(home);
  return meant ? find_key(keys, *meant) : std::nullopt;
}

void diagnose_duplicate_key(std::string_view name, Location second, Location first,
                            DiagnosticSink& sink) {
  sink.report(diag::duplicate, second, "key", name).label(first, "it is given here first");
}

namespace {

/// Reports each required key that is absent or null.
void check_required(const SourceFile& file, const Tape& tape, const Members& members,
                    const JsonObject& table, Location where, DiagnosticSink& sink) {
  for (std::size_t row = 0; row < table.keys.size(); ++row) {
    const JsonKey& key = table.keys[row];
    if (key.presence == Presence::Optional || members.value(tape, row) != 0) continue;
    const std::uint32_t name = members.names[row];
    sink.report(diag::missing, name != 0 ? Location{&file, tape[name + 1].span} : where, table.name,
                key.key);
  }
}

}  // namespace

Members find_members(const SourceFile& file, const Tape& tape, std::uint32_t object,
                     const JsonObject& table, Location where, DiagnosticSink& sink) {
  Members members;
  std::vector<std::pair<std::size_t, std::uint32_t>> guesses;  // rows and names of misspelt keys
  std::string buffer;
  std::size_t guess = 0;
  const std::uint32_t end = tape[object].next;
  // The last name has no value if the parse stopped there.
  for (std::uint32_t i = object + 1; i + 1 < end; i = tape[i + 1].next) {
    if (sink.error_count() > kMaxConfigErrors) break;
    if (tape[i].type == JsonNodeType::Error) continue;  // a missing name, which has been reported
    const std::string_view name = member_name(file, tape[i], buffer);
    const auto row = find_key(table.keys, name, guess);
    const Location place{&file, tape[i].content()};
    if (!row) {
      const auto meant = diagnose_unknown_key(table.keys, table.name, name, place, sink);
      if (meant) guesses.emplace_back(*meant, i);
    } else if (members.names[*row] != 0) {
      diagnose_duplicate_key(name, place, {&file, tape[members.names[*row]].content()}, sink);
    } else {
      members.names[*row] = i;
      guess = *row + 1;
    }
  }
  for (const auto& [row, name] : guesses) {
    if (members.names[row] == 0) members.names[row] = name;
  }
  if (tape[object].is_complete) check_required(file, tape, members, table, where, sink);
  return members;
}

}  // namespace sdlc::lang
