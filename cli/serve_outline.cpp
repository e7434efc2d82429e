#include "cli/serve_outline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <system_error>

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

/// The beginnings of the objects around the offset, the innermost first.
void find_objects(lang::ast::Node node, std::uint32_t offset, std::vector<std::uint32_t>& begins) {
  for (const lang::ast::Node child : node.children()) {
    const lang::Span span = child.span();
    if (offset < span.begin || offset > span.end) continue;
    find_objects(child, offset, begins);
    if (child.is(lang::SyntaxKind::Object)) begins.push_back(span.begin);
  }
}

/// The same of a config.
std::vector<std::uint32_t> config_objects(std::string_view text, std::uint32_t offset) {
  std::vector<std::uint32_t> begins;
  bool is_in_string = false;
  for (std::uint32_t i = 0; i < text.size() && i <= offset; ++i) {
    if (is_in_string && text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      is_in_string = !is_in_string;
    } else if (!is_in_string && text[i] == '{') {
      begins.push_back(i);
    } else if (!is_in_string && text[i] == '}' && i < offset && !begins.empty()) {
      begins.pop_back();
    }
  }
  std::ranges::reverse(begins);
  return begins;
}

/// A text, and the beginnings of the objects around the cursor in it, the innermost first.
struct ObjectsAtCursor {
  const lang::SourceFile* file = nullptr;  // null: the scene does not have it
  std::vector<std::uint32_t> begins{};
};

ObjectsAtCursor objects_in_scenes(lang::Program& program, const TextPlace& cursor) {
  for (std::uint32_t i = 0; i < program.module_count(); ++i) {
    const lang::Module& module = program.module(i);
    if (!are_same_file(module.file->name(), cursor.path)) continue;
    ObjectsAtCursor objects{.file = module.file};
    find_objects(lang::ast::Node(module.tree, 0),
                 lang::nearest_offset(*module.file, cursor.position), objects.begins);
    return objects;
  }
  return {};
}

/// Looks only in configs that made one of the spheres.
ObjectsAtCursor objects_in_configs(std::span<const lang::Origin> origins, const TextPlace& cursor) {
  const lang::SourceFile* last = nullptr;
  for (const lang::Origin& origin : origins) {
    const lang::SourceFile* const file = origin.where.file;
    if (file == nullptr || file == last) continue;
    last = file;
    if (!are_same_file(file->name(), cursor.path)) continue;
    return {.file = file,
            .begins = config_objects(file->text(), lang::nearest_offset(*file, cursor.position))};
  }
  return {};
}

}  // namespace

Outline outline_at(ServedScene& scene, const TextPlace& cursor) {
  if (!reads(scene, cursor.path)) return {};
  ObjectsAtCursor objects;
  if (lang::Program* const program = scene.compiler->program()) {
    objects = objects_in_scenes(*program, cursor);
    if (objects.file != nullptr && objects.begins.empty()) return {};
  }

  const SphereMap map = map_spheres(scene);
  std::vector<std::uint32_t> seen = map.spheres;
  std::ranges::sort(seen);
  seen.erase(std::ranges::unique(seen).begin(), seen.end());
  if (!seen.empty() && seen.back() == kNoSphere) seen.pop_back();
  const std::vector<lang::Origin> origins = scene.compiler->trace_again(seen);
  if (objects.file == nullptr) objects = objects_in_configs(origins, cursor);
  // The place of each sphere among the objects; the innermost one that any sphere has counts.
  std::vector<std::size_t> depths(seen.size(), objects.begins.size());
  for (std::size_t i = 0; i < origins.size(); ++i) {
    const auto take = [&](const lang::Location& where) {
      if (where.file != objects.file) return;
      const auto found = std::ranges::find(objects.begins, where.span.begin);
      depths[i] = std::min(depths[i], static_cast<std::size_t>(found - objects.begins.begin()));
    };
    take(origins[i].where);
    for (const lang::ChainLink& link : origins[i].chain) take(link.where);
  }
  const auto innermost = std::ranges::min_element(depths);
  if (innermost == depths.end() || *innermost == objects.begins.size()) return {};
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
