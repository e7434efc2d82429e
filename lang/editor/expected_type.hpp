#pragma once

#include <cstdint>
#include <string_view>

#include "lang/editor/cursor_place.hpp"
#include "lang/editor/scene_view.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The values that are accepted at a place.
struct ExpectedType {
  std::string_view type = {};          ///< of types.hpp; empty: unknown, or by `property`
  const Property* property = nullptr;  ///< whose value it is, if it is the whole value
  /// Of numbers: which units fit.
  enum class Units : std::uint8_t { None, Any, Length, Time } units = Units::Any;
  bool is_condition = false;  ///< a bool, probably a comparison

  /// Whether nothing is known.
  bool is_unknown() const noexcept { return type.empty() && property == nullptr; }
};

/// What is expected at the cursor.
ExpectedType expected_at(const SceneView& view, std::uint32_t file, const CursorPlace& place);

/// The property, argument or parameter whose value the bracket's current part is.
ExpectedType expected_in(const SceneView& view, std::uint32_t file, const CursorPlace& place,
                         std::size_t bracket);

}  // namespace sdlc::lang
