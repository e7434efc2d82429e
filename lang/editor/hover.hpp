#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lang/editor/scene_view.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// What an editor shows about a place in a text.
struct Hover {
  Span where;  ///< what it describes
  std::string markdown;
};

/// Describes the name, literal, keyword, operator or allowance at the offset; nullopt for anything
/// else. The value of an expression is that at the first frame.
std::optional<Hover> hover(SceneView& view, std::uint32_t file, std::uint32_t offset);

/// The text of Markdown that hover() has made, for clients that cannot show it.
std::string to_plain_text(std::string_view markdown);

}  // namespace sdlc::lang
