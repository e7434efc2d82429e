#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/environment.hpp"
#include "cli/scene_options.hpp"
#include "lang/compile/compile.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/workspace/document.hpp"

namespace sdlc::cli {

struct MadePack {
  std::string archive;
  std::vector<std::filesystem::path> files;  ///< that are in it besides the scene
};

/// Packs a scene with all files that it may read, without evaluating it. `sink`: of the compiler.
/// Prints findings, and returns nullopt if there are errors.
std::optional<MadePack> make_pack(const SceneOptions& options, const lang::Document& scene,
                                  lang::Compiler& compiler, lang::DiagnosticSink& sink,
                                  Environment& env);

}  // namespace sdlc::cli
