#include "cli/precision_json.hpp"

#include <cstdint>
#include <optional>

namespace sdlc::cli {

using Json = nlohmann::ordered_json;

Json bound_json(const render::PrecisionBound& bound) {
  const auto index = [](std::optional<std::uint32_t> sphere) {
    return sphere ? Json(*sphere) : Json();
  };
  return {{"value", bound.value},
          {"limit", bound.limit},
          {"share", bound.share},
          {"sphere", index(bound.sphere)},
          {"other", index(bound.other)}};
}

Json deciding_bound_json(const render::PrecisionBounds& bounds) {
  const render::PrecisionClause clause = bounds.deciding();
  Json json{{"clause", name_of(clause)}};
  json.update(bound_json(bounds[clause]));
  return json;
}

}  // namespace sdlc::cli
