#pragma once

#include <cstddef>
#include <optional>
#include <type_traits>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/lowered_scene.hpp"
#include "lang/lower/overrides.hpp"
#include "lang/object/object.hpp"
#include "lang/source/source.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::lang {

/// What settings are made of: the scene's `render`, and the flags that win over it.
struct WantedSettings {
  const SourceFile& file;
  const Object& render;  ///< empty if the scene has none
  const Overrides& overrides;
  DiagnosticSink& sink;

  bool is_written(std::size_t property) const { return render.slot(property).is_written; }
  /// Where the property is written; no file: nowhere.
  Location place(std::size_t property) const {
    return is_written(property) ? render.location(property) : Location{};
  }
  /// The value of the flag, else the written one, else the default; nullopt where what is written
  /// is wrong, or nothing is and there is no default.
  template <typename T>
  std::optional<T> get(std::size_t property) const {
    return overrides.has(property) ? overrides.get<T>(property) : render.get<T>(property);
  }
  /// The same of a property that is a whole number or a word, as the renderer has it.
  template <typename T>
  std::optional<T> get_as(std::size_t property) const {
    if constexpr (render::Choice<T>) {
      const auto word = get<Word>(property);
      return word ? render::choice_named<T>(word->text) : std::nullopt;
    } else {
      static_assert(std::is_integral_v<T>);
      const auto number = get<double>(property);
      return number ? std::optional(static_cast<T>(*number)) : std::nullopt;
    }
  }
};

/// Reads all settings but the size. `is_plain`: the picture has no camera.
void lower_settings(const WantedSettings& wanted, bool is_plain, LoweredScene& lowered);

/// Sets the picture's size and the camera's aspect: flags decide first, then `width` and `height`,
/// then the aspect of `camera`, which may be null. A size that cannot be known is 0.
void lower_size(const WantedSettings& wanted, const Object* camera, LoweredScene& lowered);

/// Reports an output that names no picture, or that every frame of a film would overwrite.
void check_output(const WantedSettings& wanted, bool is_animated, const LoweredScene& lowered);

}  // namespace sdlc::lang
