#include "render/scene/depth_of_field.hpp"

#include <fmt/format.h>

namespace sdlc::render {

std::string describe(const DepthOfField& sharp) {
  return fmt::format("{:.4g} to {}", sharp.from,
                     sharp.to ? fmt::format("{:.4g}", *sharp.to) : "infinity");
}

}  // namespace sdlc::render
