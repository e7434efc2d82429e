#include "cli/config_schema.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "lang/object/check.hpp"
#include "lang/schema/property_text.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

Json reference(std::string_view definition) {
  return {{"$ref", fmt::format("#/$defs/{}", definition)}};
}

void add_range(Json& schema, lang::Range range) {
  switch (range) {
    case lang::Range::Any: break;
    case lang::Range::NonNegative: schema["minimum"] = 0; break;
    case lang::Range::NonNegativeExact:
      schema["minimum"] = 0;
      schema["maximum"] = std::int64_t{1} << 53;
      break;
    case lang::Range::Positive: schema["exclusiveMinimum"] = 0; break;
    case lang::Range::AtLeastOne: schema["minimum"] = 1; break;
    case lang::Range::ByteCode:
      schema["minimum"] = 0;
      schema["maximum"] = 255;
      break;
    case lang::Range::Fraction:
      schema["minimum"] = 0;
      schema["maximum"] = 1;
      break;
    case lang::Range::PositiveFraction:
      schema["exclusiveMinimum"] = 0;
      schema["maximum"] = 1;
      break;
    case lang::Range::Kelvin:
      schema["minimum"] = 1667;
      schema["maximum"] = 25000;
      break;
    case lang::Range::UpToHundred:
      schema["minimum"] = 0;
      schema["maximum"] = 100;
      break;
    case lang::Range::Octaves:
      schema["minimum"] = 1;
      schema["maximum"] = 32;
      break;
    case lang::Range::BetweenZeroAndHalfTurn:
      schema["exclusiveMinimum"] = 0;
      schema["exclusiveMaximum"] = 180;
      break;
  }
}

Json number(lang::Range range) {
  Json schema{{"type", "number"}};
  add_range(schema, range);
  return schema;
}

Json whole_number(lang::Range range) {
  Json schema{{"type", "integer"}};
  add_range(schema, range);
  constexpr auto kMax = static_cast<std::int64_t>(lang::kMaxWholeNumber);
  if (!schema.contains("minimum")) schema["minimum"] = -kMax;
  if (!schema.contains("maximum")) schema["maximum"] = kMax;
  return schema;
}

Json numbers(std::size_t count, lang::Range range) {
  return {{"type", "array"}, {"items", number(range)}, {"minItems", count}, {"maxItems", count}};
}

Json movement() {
  const Json time = number(lang::Range::Any);
  return {{"type", "array"},
          {"prefixItems", {numbers(3, lang::Range::Any), time, time}},
          {"items", false},
          {"minItems", 3},
          {"maxItems", 3}};
}

Json object_schema(const lang::JsonObject& table);
Json materials();

Json value_schema(const lang::JsonKey& key, lang::Range range) {
  switch (key.type) {
    case lang::JsonType::Number:
    case lang::JsonType::Degrees: return number(range);
    case lang::JsonType::WholeNumber: return whole_number(range);
    case lang::JsonType::Bool: return {{"type", "boolean"}};
    // File names cannot contain NUL.
    case lang::JsonType::String: return {{"type", "string"}, {"pattern", "^[^\\u0000]*$"}};
    case lang::JsonType::Triple:
    case lang::JsonType::Color: return numbers(3, range);
    case lang::JsonType::Interval: return numbers(2, range);
    case lang::JsonType::Movement: return movement();
    case lang::JsonType::Object: return object_schema(*key.object);
    case lang::JsonType::Material: return reference("material");
    case lang::JsonType::Spheres: return {{"type", "array"}, {"items", reference("sphere")}};
  }
  return {};
}

Json key_schema(const lang::JsonKey& key) {
  const lang::Range range =
      key.target != nullptr ? key.target->properties[key.property].range : key.range;
  Json schema = value_schema(key, range);
  if (key.presence == lang::Presence::Optional) {
    schema = {{"anyOf", {std::move(schema), {{"type", "null"}}}}};
  }
  const std::string text(lang::doc_of(key));
  if (!text.empty()) schema["description"] = text;
  return schema;
}

Json object_schema(const lang::JsonObject& table) {
  Json properties = Json::object(), required = Json::array();
  for (const lang::JsonKey& key : table.keys) {
    properties[std::string(key.key)] = key_schema(key);
    if (key.presence == lang::Presence::Required) required.push_back(key.key);
  }
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

Json material_schema(const lang::MaterialInfo& material) {
  Json properties{{"type", {{"const", material.json_name}}}}, required{"type"};
  for (const lang::JsonKey& key : lang::json_material_keys(material.id)) {
    const lang::Property& argument = material.arguments[key.property];
    Json& property = properties[std::string(key.key)] = value_schema(key, argument.range);
    property["description"] = argument.doc;
    required.push_back(key.key);
  }
  return {{"type", "object"},
          {"description", material.doc},
          {"properties", std::move(properties)},
          {"required", std::move(required)},
          {"additionalProperties", false}};
}

Json materials() {
  Json alternatives = Json::array();
  for (const lang::MaterialInfo& material : lang::all_materials()) {
    alternatives.push_back(material_schema(material));
  }
  return {{"oneOf", std::move(alternatives)}};
}

/// A config is a scene or, if it has an `image`, a plain picture.
void add_alternatives(Json& schema) {
  const std::string image = "image", saving = "saving";
  Json& properties = schema["properties"];
  Json required = Json::array(), in_scene = Json::object(), in_picture = Json::object();
  for (const lang::JsonKey& key : lang::json_config().keys) {
    const std::string name(key.key);
    if (name == image || name == saving) continue;
    in_picture[name] = {{"type", "null"}};
    if (key.presence == lang::Presence::Optional) continue;
    required.push_back(name);
    in_scene[name] = {{"type", "object"}};
    Json alternatives{properties[name], {{"type", "null"}}};
    properties[name] = {{"anyOf", std::move(alternatives)}};
  }
  schema["required"] = {saving};
  schema["if"] = {{"properties", {{image, {{"type", "object"}}}}}, {"required", {image}}};
  schema["then"] = {{"properties", std::move(in_picture)}};
  schema["else"] = {{"properties", std::move(in_scene)}, {"required", std::move(required)}};
}

}  // namespace

nlohmann::ordered_json config_schema() {
  Json schema{
      {"$schema", "https://json-schema.org/draft/2020-12/schema"},
      {"$id", "urn:sdlc:config"},
      {"title", "sdlc config"},
      {"description", "A scene of spheres, or a plain picture, as `sdlc render` takes it."}};
  schema.update(object_schema(lang::json_config()));
  add_alternatives(schema);
  schema["$defs"] = {{"sphere", object_schema(lang::json_sphere())}, {"material", materials()}};
  return schema;
}

}  // namespace sdlc::cli
