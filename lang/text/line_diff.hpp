#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace sdlc::lang {

/// The lines of a text with their line ends; the last may have none. An empty text has no lines.
std::vector<std::string_view> lines_of(std::string_view text);

/// Lines [a_begin, a_end) of one text that became lines [b_begin, b_end) of another. One of the two
/// may be empty.
struct LineChange {
  std::size_t a_begin = 0, a_end = 0, b_begin = 0, b_end = 0;

  friend bool operator==(const LineChange&, const LineChange&) = default;
};

/// The differing runs of lines, in order. Linear time for texts whose lines are mostly unique, such
/// as a file and its formatted form; the result need not be minimal.
std::vector<LineChange> changed_lines(std::span<const std::string_view> a,
                                      std::span<const std::string_view> b);

}  // namespace sdlc::lang
