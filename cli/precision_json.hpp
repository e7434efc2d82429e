#pragma once

#include <nlohmann/json.hpp>

#include "render/exactness/precision.hpp"

namespace sdlc::cli {

/// One bound: value, limit, the share of the limit, and the deciding spheres.
nlohmann::ordered_json bound_json(const render::PrecisionBound& bound);

/// The bound with the largest share, and its name.
nlohmann::ordered_json deciding_bound_json(const render::PrecisionBounds& bounds);

}  // namespace sdlc::cli
