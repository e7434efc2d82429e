#pragma once

#include <nlohmann/json.hpp>

#include "render/scene/precision.hpp"

namespace sdlc::cli {

/// One bound: value, limit, the share of what is allowed, and the spheres that decide.
nlohmann::ordered_json bound_json(const render::PrecisionBound& bound);

/// The bound with the largest share, and which it is.
nlohmann::ordered_json deciding_bound_json(const render::PrecisionBounds& bounds);

}  // namespace sdlc::cli
