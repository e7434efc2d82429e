#pragma once

#include <optional>
#include <string_view>

#include "lang/editor/navigation.hpp"
#include "lang/editor/scene_view.hpp"

namespace sdlc::lang {

/// Resolves the scene again with the new name at all `places` that its files have, and returns the
/// first name that means something else then, or whose statement is parsed differently; nullopt if
/// all stays the same.
std::optional<Place> first_change(const SceneView& view, const PlaceSet& places,
                                  std::string_view new_name);

}  // namespace sdlc::lang
