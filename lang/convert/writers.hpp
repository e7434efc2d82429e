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

/// A config in which no mistake has been found as a scene that a person could have written:
/// materials used more than once are declared first and have names, numbers are spelled as in the
/// config, defaults are left out. Keys without effect are kept as comments and warned about; how
/// often that is so of a key that every config has is added to `forced_warnings`.
std::string write_scene(const SourceFile& config, DiagnosticSink& sink,
                        std::size_t& forced_warnings);

/// Writes the objects of a program as a config while they are handed on. What the format cannot
/// hold is reported.
class ConfigWriter final : public ObjectSink {
 public:
  /// `preferred`: numbers of colours that the program spells out, ascending.
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

  /// The config of all that was added, as it was lowered.
  std::string finish(const LoweredScene& lowered, std::optional<int> frame);
  /// Whether the config has the very colours of the scene.
  bool has_all_colors() const noexcept { return !has_rounded_colors_; }

 private:
  struct Group {
    std::array<render::Placement, 2> placements;  ///< at the opening and the closing, in the world
    bool is_moving = false;
    std::optional<MaterialValue> material;
    Location material_where;
  };

  const Object* camera() const;
  void diagnose_foreign_properties(const Object& object);
  void add_sphere(const Object& object);
  /// The centre at the opening, and `, "movement": …` if it moves.
  std::string place_text(const Object& sphere);
  std::string color_text(render::LinearRgb color, Location where);
  std::string material_text(const MaterialValue& material, Location where);

  std::optional<std::string> value_text(const JsonKey& key, const LoweredScene& lowered);
  std::optional<std::string> camera_text(const JsonKey& key, const LoweredScene& lowered);
  std::optional<std::string> render_text(const JsonKey& key, const LoweredScene& lowered);
  std::optional<std::string> setting_text(JsonSetting setting, const LoweredScene& lowered);
  std::optional<std::string> background_text(const LoweredScene& lowered);
  std::string object_text(const JsonObject& table, const LoweredScene& lowered);
  void check_tone(const LoweredScene& lowered);
  void check_shutter();
  void check_height(const LoweredScene& lowered);

  ObjectSink& next_;
  std::optional<std::string> chosen_camera_;
  std::vector<double> preferred_;
  DiagnosticSink& sink_;
  std::vector<Object> cameras_;
  std::optional<Object> background_, render_;
  std::vector<Group> groups_;
  std::string spheres_;  ///< each on a line
  CountedBytes bytes_;
  std::optional<int> frame_;
  bool has_moving_spheres_ = false;
  bool has_rounded_colors_ = false;
};

/// Whether both lower to the same picture, bit for bit but for the signs of zeros.
bool is_same_picture(const LoweredScene& a, const LoweredScene& b, bool compares_colors);

}  // namespace sdlc::lang
