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
#include "render/session/render.hpp"

/// The output of `sdlc inspect`.
namespace sdlc::cli {

/// A sphere that decides whether a precision is accepted.
struct DecidingSphere {
  std::uint32_t sphere = 0;
  lang::Location where{};  ///< without a file if the search for it would have taken too many steps
};

/// How close the scene is to the bounds of a precision.
struct PrecisionFigures {
  render::Precision precision;
  render::PrecisionBounds bounds;
  std::vector<std::uint32_t> exact_spheres;  ///< traced in double; for Mixed only
  std::vector<DecidingSphere> deciding;      ///< in the order of their roles
};

/// Everything about a scene at one frame.
struct InspectReport {
  std::string scene;                      ///< the file, as the user named it
  std::size_t errors = 0;                 ///< if any, the report excludes the invalid parts
  std::vector<std::string> dependencies;  ///< the other files that were read
  std::optional<lang::Animation> animation;
  int frame = 0;  ///< the reported frame of the animation
  lang::LoweredScene lowered;
  std::optional<std::string> output;  ///< the picture's file; nullopt without a name
  MaterialCounts materials;
  std::optional<SphereFigures> spheres;
  MemoryFigures memory;
  std::vector<std::string> features;
  render::Kernel kernel;
  std::vector<PrecisionFigures> precisions;  ///< none without a camera
  lang::CompileTimes times;
};

/// A sphere and its origin.
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
