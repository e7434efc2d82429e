#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/material_table.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/image/tone.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::lang {

/// What the command line puts in place of what the file says. Numbers are in the range of their
/// property.
struct Overrides {
  std::optional<int> width = {}, height = {}, samples = {}, depth = {}, threads = {};
  std::optional<std::uint64_t> seed = {};
  std::optional<std::string> tone = {}, camera = {};
};

/// How the picture is saved, as far as the scene says so.
struct OutputSettings {
  std::string output;  ///< as written; empty where the scene names none
  render::Tone tone = render::Tone::Srgb;
};

/// A scene ready for the renderer. A plain picture is a scene without spheres.
struct LoweredScene {
  render::Scene scene;
  render::RenderSettings settings;
  OutputSettings output;
};

/// Makes the renderer's scene of checked objects.
class SceneBuilder final : public ObjectSink {
 public:
  /// `file` is the one all objects come from, and the place of a fault that has no other.
  SceneBuilder(const SourceFile& file, DiagnosticSink& sink) : file_(&file), sink_(&sink) {}

  void add(const Object& object) override;

  /// The scene, or nothing when an error has been reported, here or before. Takes what was added.
  std::optional<LoweredScene> finish(const Overrides& overrides);

 private:
  struct MovingSphere {
    std::uint32_t sphere;
    std::uint32_t place;  ///< of the motion in the text
    MotionValue motion;
  };

  void add_sphere(const Object& object);
  const Object* choose_camera(const Overrides& overrides);
  void lower_camera(const Object& camera, render::Scene& scene);
  void lower_background(render::Scene& scene);
  void lower_motion(render::Interval shutter, render::Scene& scene);
  void lower_settings(const Overrides& overrides, LoweredScene& lowered);
  /// Width, height and the aspect of the view plane, which the camera's aspect and both formats'
  /// sizes decide.
  void lower_size(const Object* camera, const Overrides& overrides, LoweredScene& lowered);
  void drop_coincident(render::Scene& scene);

  Location whole_file() const { return {file_, {0, 0}}; }
  Location place_of(std::uint32_t begin) const { return {file_, {begin, begin + 1}}; }
  std::string_view name_of(const Object& object, std::size_t property) const;
  /// The value of a whole-number property, checked to fit an int; nothing where it is absent or
  /// wrong.
  std::optional<int> whole(const Object& object, std::size_t property) const;

  const SourceFile* file_;
  DiagnosticSink* sink_;
  std::vector<Object> cameras_;
  std::optional<Object> background_;
  std::optional<Object> render_;
  std::vector<render::Sphere> spheres_;
  std::vector<std::uint32_t> places_;  ///< where each sphere begins in the text
  std::vector<MovingSphere> moving_;
  MaterialTable materials_;
};

}  // namespace sdlc::lang
