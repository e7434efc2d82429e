#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "cli/serve_scene.hpp"
#include "lang/source/source.hpp"

namespace sdlc::cli {

/// A place in a text, where an editor's cursor is.
struct TextPlace {
  std::filesystem::path path;
  lang::Position position = {};
};

/// Pixels of a row.
struct PixelRow {
  int x = 0, y = 0, width = 0;
};

/// The outline of the spheres that the statement at the cursor makes: of the innermost one that
/// makes any. In squares of `step` pixels, whose corners have whole multiples of it. Looks at
/// about 50,000 pixels. Precondition: the scene is prepared.
struct Outline {
  int step = 1;
  std::vector<PixelRow> rows{};
};
Outline outline_at(ServedScene& scene, const TextPlace& cursor);

}  // namespace sdlc::cli
