#pragma once

#include <nlohmann/json.hpp>

namespace sdlc::cli {

/// The tables of the language for tools: kinds with their properties, constructors, functions,
/// types, limits, colour names and diagnostics.
nlohmann::ordered_json language_tables();

}  // namespace sdlc::cli
