#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "lang/convert/convert.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/placement.hpp"
#include "lang/object/counted_bytes.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The text of a config without mistakes as a scene: materials used more than once are declared
/// first, numbers keep their spelling, defaults are omitted. Keys without effect become comments
/// and warnings; `forced_warnings` counts the warnings about required keys.
std::string write_scene(const SourceFile& config, DiagnosticSink& sink,
                        std::size_t& forced_warnings);

/// Writes the objects of a program as a config and passes them on to `next`. Reports what the
/// format cannot represent.
class ConfigWriter final : public ObjectSink {
 public:
  /// `preferred`: the numbers in the program's colours, ascending.
  ConfigWriter(ObjectSink& next, std::optional<std::string> camera, std::vector<double> preferred,
               DiagnosticSink& sink)
      : next_(next),
        chosen_camera_(std::move(camera)),
        preferred_(std::move(preferred)),
        sink_(sink) {}

  void add(const Object& object) override;
  void enter(const Object& group) override;
  void leave() override;
  bool is_full() const override { return next_.is_full(); }

  /// The config. `lowered`: the scene of the added objects.
  std::string finish(const LoweredScene& lowered, std::optional<int> frame);
  /// Whether the config has the exact colours of the scene.
  bool has_all_colors() const noexcept { return !has_rounded_colors_; }

 private:
  struct Group {
    std::array<render::Placement, 2> placements;  ///< at opening and closing, in world space
    bool is_moving = false;
    std::optional<MaterialValue> material;
    Location material_where;
  };

  struct Place {
    std::string center;    ///< at the opening
    std::string movement;  ///< `, "movement": …`; empty if the sphere is at rest
  };

  const Object* camera() const;
  void diagnose_foreign_properties(const Object& object);
  void add_sphere(const Object& object);
  Place place_of(const Object& sphere);
  std::string color_text(render::LinearRgb color, Location where);
  std::string material_text(const MaterialValue& material, Location where);

  // The rest of the config, in config_settings.cpp.
  std::optional<std::string> value_text(const JsonKey& key);
  std::optional<std::string> camera_text(const JsonKey& key);
  std::optional<std::string> render_text(const JsonKey& key);
  std::optional<std::string> setting_text(JsonSetting setting);
  std::optional<std::string> background_text();
  std::string object_text(const JsonObject& table, std::string_view indent);
  void check_tone();
  void check_shutter();
  void check_height();

  ObjectSink& next_;
  std::optional<std::string> chosen_camera_;
  std::vector<double> preferred_;
  DiagnosticSink& sink_;
  std::vector<Object> cameras_;
  std::optional<Object> background_, render_;
  std::vector<Group> groups_;
  std::string spheres_;  ///< one per line
  CountedBytes bytes_;
  const LoweredScene* lowered_ = nullptr;  ///< during finish()
  std::optional<int> frame_;
  bool has_moving_spheres_ = false;
  bool has_rounded_colors_ = false;
};

std::string vector_text(render::Vec3 v);

/// Whether both have the same picture, bit for bit except the signs of zeros.
bool is_same_picture(const LoweredScene& a, const LoweredScene& b, bool compares_colors);

}  // namespace sdlc::lang
