#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "lang/source/source.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

/// Values in the JSON of reports and messages.
namespace sdlc::cli {

using Json = nlohmann::ordered_json;

inline Json triple(render::Vec3 v) { return {v.x, v.y, v.z}; }
inline Json triple(render::LinearRgb c) { return {c.r, c.g, c.b}; }

/// On one line; what is not UTF-8 is replaced.
inline std::string to_line(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

inline Json text_or_null(const std::string& text) { return text.empty() ? Json() : Json(text); }

/// The beginning of a span: lines and columns from 1, columns in code points, as in diagnostics.
/// Null without a file.
inline Json location_json(const lang::Location& where) {
  if (where.file == nullptr) return nullptr;
  const lang::Position position = where.file->position(where.span.begin);
  return {{"file", where.file->name()}, {"line", position.line}, {"column", position.column}};
}

}  // namespace sdlc::cli
