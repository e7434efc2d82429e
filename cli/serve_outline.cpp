#include "cli/serve_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>
#include <utility>

#include "lang/ast/ast.hpp"
#include "lang/resolve/module.hpp"
#include "lang/source/nearest_offset.hpp"
#include "lang/source/source.hpp"

namespace sdlc::cli {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kNoSphere = std::numeric_limits<std::uint32_t>::max();

/// The spheres at the centres of squares of the picture, row by row.
struct SphereMap {
  int step = 1, width = 0, height = 0;
  std::vector<std::uint32_t> spheres{};

  std::uint32_t at(int x, int y) const {
    if (x < 0 || y < 0 || x >= width || y >= height) return kNoSphere;
    return spheres[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(x)];
  }
};

SphereMap map_spheres(const ServedScene& scene) {
  constexpr double kPixels = 50'000;
  const render::RenderSettings& settings = scene.lowered.settings;
  const double pixels = static_cast<double>(settings.width) * settings.height;
  SphereMap map{.step = std::max(1, static_cast<int>(std::ceil(std::sqrt(pixels / kPixels))))};
  map.width = (settings.width + map.step - 1) / map.step;
  map.height = (settings.height + map.step - 1) / map.step;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const int px = std::min(x * map.step + map.step / 2, settings.width - 1);
      const int py = std::min(y * map.step + map.step / 2, settings.height - 1);
      const auto picked = scene.prepared->pick(
          settings, static_cast<std::uint64_t>(py) * static_cast<std::uint64_t>(settings.width) +
                        static_cast<std::uint64_t>(px));
      map.spheres.push_back(picked && !picked->instance ? picked->sphere : kNoSphere);
    }
  }
  return map;
}

bool is_same_file(const lang::SourceFile& file, const fs::path& path) {
  std::error_code ignored;
  return fs::weakly_canonical(file.name(), ignored) == fs::weakly_canonical(path, ignored);
}

/// The beginnings of the objects around the offset, the innermost first.
void find_objects(lang::ast::Node node, std::uint32_t offset, std::vector<std::uint32_t>& begins) {
  for (const lang::ast::Node child : node.children()) {
    const lang::Span span = child.span();
    if (offset < span.begin || offset > span.end) continue;
    find_objects(child, offset, begins);
    if (child.is(lang::SyntaxKind::Object)) begins.push_back(span.begin);
  }
}

constexpr std::size_t kOutside = std::numeric_limits<std::size_t>::max();

/// Says how far the cursor is inside what made a sphere: 0 is innermost.
using Depth = std::function<std::size_t(const lang::Origin& origin)>;

/// Of a cursor in a scene: by the objects of the text. Null if it is in none.
Depth depth_in_scene(const lang::Module& module, const TextPlace& cursor) {
  std::vector<std::uint32_t> objects;
  find_objects(lang::ast::Node(module.tree, 0), lang::nearest_offset(*module.file, cursor.position),
               objects);
  if (objects.empty()) return nullptr;
  return [&module, objects = std::move(objects)](const lang::Origin& origin) {
    std::size_t depth = kOutside;
    const auto take = [&](const lang::Location& where) {
      if (where.file != module.file) return;
      const auto found = std::ranges::find(objects, where.span.begin);
      if (found == objects.end()) return;
      depth = std::min(depth, static_cast<std::size_t>(found - objects.begin()));
    };
    take(origin.where);
    for (const lang::ChainLink& link : origin.chain) take(link.where);
    return depth;
  };
}

/// Of a cursor in a config: only the spheres themselves.
Depth depth_in_config(const TextPlace& cursor) {
  return [&cursor](const lang::Origin& origin) {
    const lang::SourceFile* const file = origin.where.file;
    if (file == nullptr || !is_same_file(*file, cursor.path)) return kOutside;
    const std::uint32_t offset = lang::nearest_offset(*file, cursor.position);
    const lang::Span span = origin.where.span;
    return offset >= span.begin && offset <= span.end ? 0 : kOutside;
  };
}

Depth depth_at(lang::Program* program, const TextPlace& cursor) {
  for (std::uint32_t i = 0; program != nullptr && i < program->module_count(); ++i) {
    const lang::Module& module = program->module(i);
    if (is_same_file(*module.file, cursor.path)) return depth_in_scene(module, cursor);
  }
  return depth_in_config(cursor);
}

}  // namespace

Outline outline_at(ServedScene& scene, const TextPlace& cursor) {
  const Depth depth = depth_at(scene.compiler->program(), cursor);
  if (!depth) return {};
  const SphereMap map = map_spheres(scene);
  std::vector<std::uint32_t> seen = map.spheres;
  std::ranges::sort(seen);
  seen.erase(std::ranges::unique(seen).begin(), seen.end());
  if (!seen.empty() && seen.back() == kNoSphere) seen.pop_back();
  const std::vector<lang::Origin> origins = scene.compiler->trace_again(seen);
  // The innermost object that any sphere has counts.
  std::vector<std::size_t> depths(seen.size(), kOutside);
  std::ranges::transform(origins, depths.begin(), depth);
  const auto innermost = std::ranges::min_element(depths);
  if (innermost == depths.end() || *innermost == kOutside) return {};
  const auto is_meant = [&](std::uint32_t sphere) {
    const auto found = std::ranges::lower_bound(seen, sphere);
    return sphere != kNoSphere &&
           depths[static_cast<std::size_t>(found - seen.begin())] == *innermost;
  };
  Outline outline{.step = map.step};
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::uint32_t sphere = map.at(x, y);
      if (!is_meant(sphere)) continue;
      const bool is_edge = map.at(x - 1, y) != sphere || map.at(x + 1, y) != sphere ||
                           map.at(x, y - 1) != sphere || map.at(x, y + 1) != sphere;
      if (!is_edge) continue;
      if (!outline.rows.empty() && outline.rows.back().y == y * map.step &&
          outline.rows.back().x + outline.rows.back().width == x * map.step) {
        outline.rows.back().width += map.step;
      } else {
        outline.rows.push_back({.x = x * map.step, .y = y * map.step, .width = map.step});
      }
    }
  }
  return outline;
}

}  // namespace sdlc::cli
