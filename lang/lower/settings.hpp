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

/// The sources of settings: the scene's `render`, and the flags, which take precedence.
struct WantedSettings {
  const SourceFile& file;
  const Object& render;  ///< empty if the scene has none
  const Overrides& overrides;
  DiagnosticSink& sink;

  bool is_written(std::size_t property) const { return render.slot(property).is_written; }
  /// The place of the property; without a file if it is not written.
  Location place(std::size_t property) const {
    return is_written(property) ? render.location(property) : Location{};
  }
  /// The value of the flag, otherwise the written one, otherwise the default; nullopt if the
  /// written value is invalid, or there is none and no default.
  template <typename T>
  std::optional<T> get(std::size_t property) const {
    return overrides.has(property) ? overrides.get<T>(property) : render.get<T>(property);
  }
  /// The same for a whole number or a word, as the type of the renderer.
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

/// Lowers all settings except the size. `is_plain`: the picture has no camera.
void lower_settings(const WantedSettings& wanted, bool is_plain, LoweredScene& lowered);

/// Sets the picture's size and the camera's aspect, from the flags, `width` and `height`, and the
/// aspect of `camera`, which may be null, in this order of precedence. An unknown size is 0.
void lower_size(const WantedSettings& wanted, const Object* camera, LoweredScene& lowered);

/// Reports an output that names no picture, or that every frame of a film would overwrite.
void check_output(const WantedSettings& wanted, bool is_animated, const LoweredScene& lowered);

}  // namespace sdlc::lang
