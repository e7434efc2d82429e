#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sdlc::cli {

/// Frames first, first + step, … up to last.
struct FrameRange {
  int first = 0, last = 0, step = 1;
};

/// Parses `7`, `1-24`, `1-24x2`, or several with commas between them; nullopt if the text is none
/// of these. `1-24:2` is another spelling of `1-24x2` (Open Job Description).
std::optional<std::vector<FrameRange>> parse_frames(const std::string& text);

/// The most frames of one command.
inline constexpr std::int64_t kMaxFrames = 1'000'000;

/// The numbers of all frames, ascending, each once. Throws UsageError if the ranges have more than
/// kMaxFrames.
std::vector<int> frames_of(const std::vector<FrameRange>& ranges);

/// The same as text, as parse_frames() reads it: `1-3,5`. `frames` ascend.
std::string describe_frames(const std::vector<int>& frames);

/// The number of frames.
std::int64_t frame_count(const FrameRange& range);

/// The placeholder for the frame number in file names.
inline constexpr const char* kFrameMark = "####";

bool has_frame_mark(const std::string& name);
/// The name with each placeholder replaced by the frame number, with at least four digits.
std::string name_of_frame(const std::string& name, int frame);

}  // namespace sdlc::cli
