#include "cli/frames.hpp"

#include <algorithm>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "cli/usage_error.hpp"

namespace sdlc::cli {
namespace {

/// Removes a number from the front of the text.
std::optional<int> take_number(std::string_view& text) {
  int number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || number < 0) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return number;
}

std::optional<FrameRange> parse_range(std::string_view rest) {
  const auto first = take_number(rest);
  if (!first) return std::nullopt;
  FrameRange range{.first = *first, .last = *first};
  if (rest.starts_with('-')) {
    rest.remove_prefix(1);
    const auto last = take_number(rest);
    if (!last || *last < range.first) return std::nullopt;
    range.last = *last;
    if (rest.starts_with('x') || rest.starts_with(':')) {
      rest.remove_prefix(1);
      const auto step = take_number(rest);
      if (!step || *step < 1) return std::nullopt;
      range.step = *step;
    }
  }
  return rest.empty() ? std::optional(range) : std::nullopt;
}

}  // namespace

std::optional<std::vector<FrameRange>> parse_frames(const std::string& text) {
  std::vector<FrameRange> ranges;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    const auto range = parse_range(std::string_view(text).substr(at, end - at));
    if (!range) return std::nullopt;
    ranges.push_back(*range);
    at = end + 1;
  }
  return ranges;
}

std::vector<int> frames_of(const std::vector<FrameRange>& ranges) {
  std::int64_t count = 0;
  for (const FrameRange& range : ranges) count += frame_count(range);
  if (count > kMaxFrames) {
    throw UsageError(fmt::format("{} frames are more than {}; choose some with --frames A-B", count,
                                 kMaxFrames));
  }
  std::vector<int> frames;
  for (const FrameRange& range : ranges) {
    for (std::int64_t frame = range.first; frame <= range.last; frame += range.step) {
      frames.push_back(static_cast<int>(frame));
    }
  }
  std::ranges::sort(frames);
  const auto repeated = std::ranges::unique(frames);
  frames.erase(repeated.begin(), repeated.end());
  return frames;
}

std::string describe_frames(const std::vector<int>& frames) {
  std::string text;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const std::size_t first = i;
    while (i + 1 < frames.size() && frames[i + 1] == frames[i] + 1) ++i;
    text += fmt::format("{}{}", first > 0 ? "," : "", frames[first]);
    if (i > first) text += fmt::format("-{}", frames[i]);
  }
  return text;
}

std::int64_t frame_count(const FrameRange& range) {
  return (std::int64_t{range.last} - range.first) / range.step + 1;
}

bool has_frame_mark(const std::string& name) { return name.find(kFrameMark) != std::string::npos; }

std::string name_of_frame(const std::string& name, int frame) {
  const std::string_view mark = kFrameMark;
  const std::string number = fmt::format("{:0{}}", frame, mark.size());
  std::string result;
  std::size_t at = 0;
  for (std::size_t found = name.find(mark); found != std::string::npos;
       found = name.find(mark, at)) {
    result += name.substr(at, found - at) + number;
    at = found + mark.size();
  }
  return result + name.substr(at);
}

}  // namespace sdlc::cli
