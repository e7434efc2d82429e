#include "tests/docs/reference_tables.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/object/check.hpp"
#include "lang/report/findings.hpp"
#include "lang/schema/property_text.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/data_format.hpp"
#include "lang/source/limits.hpp"
#include "lang/value/builtins.hpp"
#include "lang/value/colors.hpp"
#include "lang/value/constructors.hpp"
#include "lang/value/types.hpp"
#include "render/image/picture.hpp"

namespace sdlc::test {
namespace {

std::string code(std::string_view text) { return fmt::format("`{}`", text); }

std::string kind_table(const lang::Kind& kind) {
  std::string text = "| property | takes | default | |\n| --- | --- | --- | --- |\n";
  for (const lang::Property& property : kind.properties) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", property.name, describe_values(property),
                        describe_default(property), property.doc);
  }
  return text;
}

/// Whether a single row describes all of them.
bool are_alike(std::span<const lang::Property> parameters) {
  return std::all_of(parameters.begin(), parameters.end(), [&](const lang::Property& parameter) {
    return describe_values(parameter) == describe_values(parameters.front());
  });
}

/// The rows of a constructor: itself, then its arguments.
std::string constructor_rows(const lang::Constructor& constructor) {
  std::string text =
      fmt::format("| **`{}`** | | {} |\n", signature_of(constructor), constructor.doc);
  std::string names, docs;
  for (const lang::Property& parameter : constructor.parameters) {
    names += (names.empty() ? "" : " ") + code(parameter.name);
    docs += fmt::format("{}{}", docs.empty() ? "" : " ", parameter.doc);
    const bool is_last = &parameter == &constructor.parameters.back();
    if (!is_last && are_alike(constructor.parameters)) continue;
    text += fmt::format("| {} | {} | {} |\n", std::exchange(names, ""), describe_values(parameter),
                        std::exchange(docs, ""));
  }
  return text;
}

std::string constructor_table(bool (*is_wanted)(const lang::Constructor&)) {
  std::string text = "| | takes | |\n| --- | --- | --- |\n";
  for (const lang::Constructor& constructor : lang::all_constructors()) {
    if (is_wanted(constructor)) text += constructor_rows(constructor);
  }
  return text;
}

bool is_material(const lang::Constructor& constructor) {
  const auto materials = lang::all_materials();
  return std::any_of(materials.begin(), materials.end(), [&](const lang::MaterialInfo& material) {
    return material.name == constructor.name;
  });
}

bool is_motion(const lang::Constructor& constructor) { return constructor.name == "line"; }

bool is_color(const lang::Constructor& constructor) {
  return !is_material(constructor) && !is_motion(constructor);
}

std::string function_table(std::string_view topic) {
  std::string text = "| function | |\n| --- | --- |\n";
  for (const lang::Builtin& builtin : lang::all_builtins()) {
    if (builtin.topic != topic) continue;
    std::string signatures = code(builtin.signature);
    for (std::size_t at = 0; (at = signatures.find("), ", at)) != std::string::npos; at += 5) {
      signatures.replace(at, 3, ")`, `");
    }
    text += fmt::format("| {} | {} |\n", signatures, builtin.doc);
    for (const lang::Property& option : builtin.options) {
      text +=
          fmt::format("| · `{}`: {} | {} |\n", option.name, describe_values(option), option.doc);
    }
  }
  return text;
}

std::string type_table() {
  std::string text = "| type | |\n| --- | --- |\n";
  for (const lang::TypeInfo& type : lang::all_types()) {
    text += fmt::format("| `{}` | {} |\n", type.name, type.doc);
  }
  return text;
}

std::string data_format_table() {
  std::string text = "| extension | |\n| --- | --- |\n";
  for (const lang::DataFormatInfo& format : lang::kDataFormats) {
    text += fmt::format("| `{}` | {} |\n", format.extension, format.doc);
  }
  return text;
}

std::string limit_table() {
  std::string text = "| limit | by default | what it counts |\n| --- | --- | --- |\n";
  const lang::Limits defaults;
  for (const lang::LimitInfo& limit : lang::kLimits) {
    text += fmt::format("| `{}` | {} | {} |\n", limit.name, defaults.*(limit.limit), limit.doc);
  }
  return text;
}

std::string fixed_limit_table() {
  return fmt::format(
      "| fixed | |\n| --- | --- |\n"
      "| {} | brackets inside brackets, in the text of a file |\n"
      "| {:.0f} | pixels, samples, rays and the like: whole numbers in properties, but for `seed` "
      "|\n"
      "| {} | pixels of a picture |\n"
      "| {} | errors that are shown of one run, and as many warnings; more are counted |\n",
      lang::kMaxNesting, lang::kMaxWholeNumber, render::kMaxPicturePixels,
      lang::FindingsFilter::kMaxShown);
}

std::string color_list() {
  std::string text, line;
  for (const lang::NamedColor& color : lang::named_colors()) {
    const bool is_last = &color == &lang::named_colors().back();
    const std::string entry =
        fmt::format("{} `#{:06x}`{}", color.name, color.encoded, is_last ? "" : " ·");
    if (line.size() + entry.size() > 110) text += std::exchange(line, "") + "\n";
    line += (line.empty() ? "" : " ") + entry;
  }
  return text + line + "\n";
}

}  // namespace

std::string shown_message(std::string_view message) {
  std::string shown(message);
  for (std::size_t at = 0; (at = shown.find("{}", at)) != std::string::npos;) {
    shown.replace(at, 2, "…");
  }
  return shown;
}

std::vector<GeneratedPart> reference_parts() {
  std::vector<GeneratedPart> parts;
  for (const lang::Kind& kind : lang::all_kinds()) {
    parts.push_back({std::string(kind.name), kind_table(kind)});
  }
  parts.push_back({"materials", constructor_table(is_material)});
  parts.push_back({"motions", constructor_table(is_motion)});
  parts.push_back({"colors", constructor_table(is_color)});
  std::set<std::string_view> topics;
  for (const lang::Builtin& builtin : lang::all_builtins()) topics.insert(builtin.topic);
  for (const std::string_view topic : topics) {
    parts.push_back({fmt::format("functions of {}", topic), function_table(topic)});
  }
  parts.push_back({"types", type_table()});
  parts.push_back({"data formats", data_format_table()});
  parts.push_back({"limits", limit_table()});
  parts.push_back({"fixed limits", fixed_limit_table()});
  parts.push_back({"named colors", color_list()});
  return parts;
}

}  // namespace sdlc::test
