#pragma once

#include <optional>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/lower/scene_builder.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Seconds that the phases of a compilation took.
struct CompileTimes {
  double parse_seconds = 0;  ///< reading the text into checked objects
  double lower_seconds = 0;  ///< making the renderer's scene of them
};

/// A text of either format as a scene for the renderer, or nothing when it has errors; what is
/// wrong with it, warnings included, is in the sink.
std::optional<LoweredScene> compile(const SourceFile& file, const Overrides& overrides,
                                    DiagnosticSink& sink, CompileTimes& times);

}  // namespace sdlc::lang
