#pragma once

#include <optional>
#include <ostream>
#include <vector>

#include "cli/render_options.hpp"
#include "lang/eval/eval.hpp"

namespace sdlc::cli {

/// The frames that a command renders.
struct FrameSelection {
  /// Ascending; nullopt is the picture of a scene without an animation.
  std::vector<std::optional<int>> frames;
  bool is_shard = false;         ///< --shard divides the frames, not each picture
  double frames_per_second = 0;  ///< of their video; 0 without an animation
};

/// The frames of --frames, otherwise those of the animation, and of these the shard of --shard.
/// Writes a warning of frames outside of the animation to `err`. Throws UsageError if there are
/// fewer frames than shards.
FrameSelection select_frames(const RenderOptions& options,
                             const std::optional<lang::Animation>& animation, std::ostream& err);

}  // namespace sdlc::cli
