#include "cli/language_tables.hpp"

#include <algorithm>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/data_format.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/types.hpp"

namespace sdlc::cli {
namespace {

using Json = nlohmann::ordered_json;

Json property_row(const lang::Property& property) {
  Json row{{"name", property.name},
           {"takes", describe(property.type)},
           {"required", property.presence == lang::Presence::Required}};
  if (property.range != lang::Range::Any) row["range"] = describe(property.range);
  if (!property.default_text.empty()) row["default"] = property.default_text;
  if (!property.words.empty()) row["words"] = property.words;
  if (property.reads_none) row["none"] = true;
  row["doc"] = property.doc;
  return row;
}

Json kind_row(const lang::Kind& kind) {
  Json properties = Json::array();
  for (std::size_t i = 0; i < kind.properties.size(); ++i) {
    properties.push_back(property_row(kind.properties[i]));
    const std::string_view key = lang::json_key_of(kind, i);
    if (!key.empty()) properties.back()["json"] = key;
  }
  return {{"name", kind.name},        {"takes_name", kind.takes_name},
          {"unique", kind.is_unique}, {"top_level_only", kind.is_setting},
          {"doc", kind.doc},          {"properties", std::move(properties)}};
}

Json constructor_row(const lang::Constructor& constructor) {
  Json parameters = Json::array();
  for (const lang::Property& parameter : constructor.parameters) {
    parameters.push_back(property_row(parameter));
  }
  Json row{{"name", constructor.name}, {"doc", constructor.doc}};
  const auto materials = lang::all_materials();
  const auto material = std::ranges::find(materials, constructor.name, &lang::MaterialInfo::name);
  const bool is_motion = constructor.name == "line";
  row["makes"] = material != materials.end() ? "material" : is_motion ? "motion" : "color";
  if (material != materials.end()) row["json"] = material->json_name;
  row["parameters"] = std::move(parameters);
  return row;
}

Json function_row(const lang::Builtin& function) {
  Json row{{"name", function.name},
           {"signature", function.signature},
           {"least_arguments", function.min_arguments},
           {"most_arguments", function.max_arguments},
           {"topic", function.topic},
           {"doc", function.doc}};
  for (const lang::Property& option : function.options) {
    row["options"].push_back(property_row(option));
  }
  return row;
}

Json limit_row(const lang::LimitInfo& limit) {
  return {{"name", limit.name}, {"default", lang::Limits{}.*(limit.limit)}, {"doc", limit.doc}};
}

Json color_row(const lang::NamedColor& color) {
  return {{"name", color.name}, {"srgb", fmt::format("#{:06x}", color.encoded)}};
}

Json diagnostic_row(const lang::DiagnosticInfo* info) {
  return {{"code", info->code},
          {"name", info->name},
          {"severity", info->severity == lang::Severity::Error ? "error" : "warning"},
          {"message", info->message}};
}

template <typename Rows, typename ToJson>
Json table(const Rows& rows, ToJson to_json) {
  Json json = Json::array();
  for (const auto& row : rows) json.push_back(to_json(row));
  return json;
}

}  // namespace

nlohmann::ordered_json language_tables() {
  return {
      {"language", 1},
      {"kinds", table(lang::all_kinds(), kind_row)},
      {"constructors", table(lang::all_constructors(), constructor_row)},
      {"functions", table(lang::all_builtins(), function_row)},
      {"types", table(lang::all_types(),
                      [](const lang::TypeInfo& type) {
                        return Json{{"name", type.name}, {"doc", type.doc}};
                      })},
      {"data_formats", table(lang::kDataFormats,
                             [](const lang::DataFormatInfo& format) {
                               return Json{{"extension", format.extension}, {"doc", format.doc}};
                             })},
      {"limits", table(lang::kLimits, limit_row)},
      {"colors", table(lang::named_colors(), color_row)},
      {"diagnostics", table(lang::all_diagnostics(), diagnostic_row)}};
}

}  // namespace sdlc::cli
