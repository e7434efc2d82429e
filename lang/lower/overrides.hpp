#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/lower/group_repeats.hpp"
#include "lang/object/object.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// The value of a flag that sets a property of `render`, in the range of the property.
struct Override {
  Override(std::size_t property_, double number) : property(property_), value(Scalar{number}) {}
  Override(std::size_t property_, std::string word)
      : property(property_), value(Word{std::move(word)}) {}

  std::size_t property;
  Value value;
};

/// Where a camera is, and the point in the middle of its picture.
struct CameraPose {
  render::Vec3 from, at;

  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// Settings of the command line that replace those of the scene.
struct Overrides {
  std::vector<Override> render = {};
  std::optional<std::uint64_t> seed = {};  ///< 64 bits; a property has only 53
  std::optional<double> seconds = {};      ///< replaces the scene's `error` and `samples`
  bool is_adaptive = false;
  bool is_denoised = false;
  std::optional<CameraPose> pose = {};  ///< of the chosen camera
  bool names_output = false;            ///< the scene's `output` is not used
  Instancing instancing = Instancing::Auto;

  /// Whether a flag sets the property of `render`.
  bool has(std::size_t property) const noexcept { return find(property) != nullptr; }
  /// The value that a flag gives the property of `render`.
  template <typename T>
  std::optional<T> get(std::size_t property) const {
    const Override* flag = find(property);
    return flag != nullptr ? value_as<T>(flag->value) : std::nullopt;
  }
  std::optional<std::string> word(std::size_t property) const {
    const auto given = get<Word>(property);
    return given ? std::optional(given->text) : std::nullopt;
  }

 private:
  const Override* find(std::size_t property) const noexcept {
    const auto found = std::ranges::find(render, property, &Override::property);
    return found == render.end() ? nullptr : &*found;
  }
};

}  // namespace sdlc::lang
