#pragma once

#include <cstdint>

#include "lang/editor/completion.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// What can be written at the offset of a JSON config: keys that are missing, and values.
CompletionList complete_config(const SourceFile& config, std::uint32_t offset);

}  // namespace sdlc::lang
