#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "cli/crop_option.hpp"
#include "cli/frames.hpp"
#include "cli/scene_options.hpp"
#include "cli/shard_option.hpp"
#include "lang/lower/overrides.hpp"
#include "render/film/aov.hpp"
#include "render/kernel/kernel.hpp"

namespace sdlc::cli {

/// The options of `render`.
struct RenderOptions {
  std::vector<std::string> files;
  SceneOptions scene;  ///< of the file that is being rendered
  std::vector<std::string> outputs;
  lang::Overrides overrides;
  render::KernelRequest kernel;
  render::Aovs aovs;
  std::optional<std::vector<FrameRange>> frames;
  std::string progress = "auto";
  std::string stats;
  bool ppm_text = false;
  std::optional<Crop> crop;
  int zoom = 1;  ///< PictureForm::zoom
  std::optional<Shard> shard;
  std::optional<ShardBy> shard_by;
  std::optional<double> checkpoint_seconds;
  bool resumes = false;
  bool keeps_existing = false;  // --no-clobber
  bool skips_existing = false;
  bool fails_fast = false;
  int crf = 18;  // VideoSettings::crf
  bool quiet = false;
  bool watches = false;
  bool has_preview = false;

  /// Whether only diagnostics and failures are printed.
  bool is_quiet() const { return quiet || progress == "none"; }
};

}  // namespace sdlc::cli
