#pragma once

#include <nlohmann/json.hpp>

namespace sdlc::cli {

/// A JSON Schema (2020-12) of the JSON config format, made from the tables of keys: what it accepts
/// has no error that concerns one key alone.
nlohmann::ordered_json config_schema();

}  // namespace sdlc::cli
