#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cli/scene_figures.hpp"
#include "lang/compile/compile.hpp"
#include "lang/eval/eval.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "render/tiles/render.hpp"

/// What `sdlc inspect` prints.
namespace sdlc::cli {

/// How near the scene comes to what numbers of one precision resolve.
struct PrecisionFigures {
  render::Precision precision;
  render::PrecisionBounds bounds;
  std::vector<std::uint32_t> exact_spheres;  ///< of Mixed
  /// Where the spheres that decide stand in the text, in the order of their roles.
  std::vector<lang::Location> places;
};

/// Everything about a scene at one frame.
struct InspectReport {
  std::string scene;                      ///< the file, as the user named it
  std::size_t errors = 0;                 ///< that the scene has; without what they are about
  std::vector<std::string> dependencies;  ///< the files that were read beside it
  std::optional<lang::Animation> animation;
  int frame = 0;  ///< of the animation: what follows is at its time
  lang::LoweredScene lowered;
  std::optional<std::string> output;  ///< the picture's file; nothing where nothing names it
  MaterialCounts materials;
  std::optional<SphereFigures> spheres;
  MemoryFigures memory;
  std::vector<std::string> features;
  render::Kernel kernel;
  std::vector<PrecisionFigures> precisions;  ///< none without a camera
  lang::CompileTimes times;
};

/// A sphere and where it comes from.
struct TracedSphere {
  std::uint32_t index = 0;
  render::Sphere sphere;
  render::Vec3 shift;
  render::MaterialType material = render::MaterialType::Diffuse;
  lang::Origin origin;
};

std::string to_text(const InspectReport& report);
std::string to_text(std::span<const TracedSphere> spheres);
/// Field names are fixed: docs/inspect.md lists them.
std::string to_json(const InspectReport& report);
std::string to_json(std::span<const TracedSphere> spheres);
/// An array of the names.
std::string to_json(std::span<const std::string> files);

}  // namespace sdlc::cli
