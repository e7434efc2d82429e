#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/image/tone.hpp"
#include "render/math/interval.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// How the scene wants its picture to be saved.
struct OutputSettings {
  std::string output;  ///< as written; empty if the scene names none
  render::ToneMapping mapping = {};
};

/// Properties of a camera that render::Camera does not have.
struct WrittenCamera {
  std::string name;  ///< may be empty
  Angle fov;
  double view_height = 2;
  std::optional<render::Interval> shutter;  ///< absolute times in seconds; nullopt: none
  Location aperture;                        ///< in the text; no file: not written
};

/// A valid camera. Checks lower all cameras, not only the chosen one.
struct CheckedCamera {
  std::string name;  ///< may be empty
  render::Camera camera;
  std::optional<render::Interval> shutter;
  Location from;                     ///< its `from` in the text
  Location aspect, aperture, focus;  ///< no file: not written
};

/// Places in the text; without a file if the setting is not written.
struct WrittenPlaces {
  Location background, width, height, samples, depth, precision, error, output;
};

/// A sphere in a group that rotates while the shutter is open; its centre moves in a straight line
/// anyway.
struct BentPath {
  std::uint32_t sphere;  ///< index in the scene
  double sagitta;        ///< distance of the line's midpoint from the true path
};

/// A scene ready for the renderer. A plain picture is a scene without spheres.
struct LoweredScene {
  render::Scene scene;
  render::RenderSettings settings;
  OutputSettings output;
  std::vector<std::string> cameras;     ///< the names of all, in the order of declaration
  std::optional<WrittenCamera> camera;  ///< the chosen one; nullopt: a plain picture
  std::size_t dropped_spheres = 0;      ///< that coincided with earlier ones
  /// The requested precision; nullopt to choose one for the scene.
  std::optional<render::Precision> precision;
  WrittenPlaces places;

  // Filled by checks only.
  std::vector<CheckedCamera> checked_cameras;  ///< empty: the file is a part of others
  std::vector<BentPath> bent_paths;            ///< by index
};

}  // namespace sdlc::lang
