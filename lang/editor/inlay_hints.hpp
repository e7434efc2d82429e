#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// A text that an editor shows within a line.
struct InlayHint {
  enum class Kind : std::uint8_t {
    Argument,  ///< `r:` before a positional argument
    Computed,  ///< `= 6.283` after a let or param
  };

  Kind kind = Kind::Argument;
  std::uint32_t offset = 0;  ///< before which it is shown
  std::string text;
};

/// The names of positional arguments and the values of computed lets and params in the range, in
/// the order of the text. Values that would take too long to compute are omitted.
std::vector<InlayHint> inlay_hints(SceneView& view, std::uint32_t file,
                                   std::optional<Span> range = std::nullopt);

}  // namespace sdlc::lang
