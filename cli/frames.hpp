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

/// `7`, `1-24` or `1-24x2`; nothing where the text is none of these.
std::optional<FrameRange> parse_frames(const std::string& text);

/// The numbers of the frames to render, ascending.
std::vector<int> frames_of(const FrameRange& range);

/// How many they are.
std::int64_t frame_count(const FrameRange& range);

/// Stands in file names for the number of the frame.
inline constexpr const char* kFrameMark = "####";

bool has_frame_mark(const std::string& name);
/// The name with the frame's number, of four digits or more, in place of each mark.
std::string name_of_frame(const std::string& name, int frame);

}  // namespace sdlc::cli
