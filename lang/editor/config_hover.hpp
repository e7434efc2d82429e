#pragma once

#include <cstdint>
#include <optional>

#include "lang/editor/hover.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// What the key or the material's type at the offset of a JSON config means.
std::optional<Hover> hover_config(const SourceFile& config, std::uint32_t offset);

}  // namespace sdlc::lang
