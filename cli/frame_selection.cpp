#include "cli/frame_selection.hpp"

#include <cstddef>

#include <fmt/format.h>

#include "cli/frames.hpp"
#include "cli/shard_option.hpp"
#include "cli/usage_error.hpp"

namespace sdlc::cli {
namespace {

void warn_of_frames_outside(const lang::Animation& animation, const std::vector<int>& frames,
                            std::ostream& err) {
  std::vector<int> outside;
  for (const int frame : frames) {
    if (frame < animation.first || frame > animation.last) outside.push_back(frame);
  }
  if (outside.empty()) return;
  err << fmt::format("warning: --frames: {} {} outside of the animation, {} to {}\n",
                     describe_frames(outside), outside.size() == 1 ? "is" : "are", animation.first,
                     animation.last);
}

/// Whether --shard divides this number of frames.
bool are_frames_divided(const RenderOptions& options, std::size_t frames) {
  if (!options.shard || frames == 0) return false;
  if (options.shard_by) return *options.shard_by == ShardBy::Frames;
  return frames >= options.shard->count;
}

std::vector<int> shard_of(const std::vector<int>& frames, const Shard& shard) {
  const auto cut = [&](std::size_t i) {
    return frames.begin() + static_cast<std::ptrdiff_t>(frames.size() * i / shard.count);
  };
  std::vector<int> part(cut(shard.index - 1), cut(shard.index));
  if (part.empty()) {
    throw UsageError(fmt::format("--shard: there are fewer frames than {} shards", shard.count));
  }
  return part;
}

}  // namespace

FrameSelection select_frames(const RenderOptions& options,
                             const std::optional<lang::Animation>& animation, std::ostream& err) {
  if (!animation) return {.frames = {std::nullopt}};
  const FrameRange all{.first = animation->first, .last = animation->last, .step = animation->step};
  std::vector<int> frames = frames_of(options.frames.value_or(std::vector{all}));
  warn_of_frames_outside(*animation, frames, err);
  const bool is_shard = are_frames_divided(options, frames.size());
  if (is_shard) frames = shard_of(frames, *options.shard);
  const int step = frames.size() > 1 ? frames[1] - frames[0] : 1;
  return {.frames = {frames.begin(), frames.end()},
          .is_shard = is_shard,
          .frames_per_second = animation->fps / step};
}

}  // namespace sdlc::cli
