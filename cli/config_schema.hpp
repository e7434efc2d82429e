#pragma once

#include <nlohmann/json.hpp>

namespace sdlc::cli {

/// A JSON Schema (2020-12) of the JSON config format, generated from the tables of keys. A config
/// that it accepts has no errors that concern a single key.
nlohmann::ordered_json config_schema();

}  // namespace sdlc::cli
