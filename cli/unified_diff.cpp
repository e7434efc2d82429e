#include "cli/unified_diff.hpp"

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "lang/text/line_diff.hpp"

namespace sdlc::cli {
namespace {

using Lines = std::span<const std::string_view>;
using lang::LineChange;

constexpr std::size_t kContext = 3;

void append_line(std::string& out, char mark, std::string_view line) {
  out += mark;
  out += line;
  if (!line.ends_with('\n')) out += "\n\\ No newline at end of file\n";
}

/// A range in the head of a hunk: its first line, and the number of lines unless it is one. An
/// empty range is after the line that it names.
std::string range_text(std::size_t begin, std::size_t end) {
  if (end - begin == 1) return fmt::format("{}", begin + 1);
  return fmt::format("{},{}", end == begin ? begin : begin + 1, end - begin);
}

/// Appends the changes from `first` to `last`, which are near each other, with the lines around
/// them.
void append_hunk(std::string& out, Lines a, Lines b, const LineChange* first,
                 const LineChange* last) {
  const std::size_t lead = std::min(kContext, first->a_begin);
  const std::size_t a_end = std::min(last->a_end + kContext, a.size());
  const std::size_t b_end = last->b_end + (a_end - last->a_end);
  out += fmt::format("@@ -{} +{} @@\n", range_text(first->a_begin - lead, a_end),
                     range_text(first->b_begin - lead, b_end));
  std::size_t at = first->a_begin - lead;
  for (const LineChange* change = first; change <= last; ++change) {
    for (; at < change->a_begin; ++at) append_line(out, ' ', a[at]);
    for (; at < change->a_end; ++at) append_line(out, '-', a[at]);
    for (std::size_t i = change->b_begin; i < change->b_end; ++i) append_line(out, '+', b[i]);
  }
  for (; at < a_end; ++at) append_line(out, ' ', a[at]);
}

/// The name as `patch` and `git apply` read it: a name with a space is terminated by a tab, as in
/// GNU diff, and one that would end early is quoted, as in git.
std::string shown_name(std::string_view name) {
  const auto is_plain = [](unsigned char c) {
    return c >= ' ' && c != 0x7F && c != '"' && c != '\\';
  };
  if (std::ranges::all_of(name, is_plain) && !name.starts_with(' ')) {
    return std::string(name) + (name.find(' ') != std::string_view::npos ? "\t" : "");
  }
  std::string quoted = "\"";
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      quoted += {'\\', c};
    } else {
      quoted += is_plain(byte) ? std::string(1, c) : fmt::format("\\{:03o}", byte);
    }
  }
  return quoted + "\"";
}

}  // namespace

std::string unified_diff(std::string_view name, std::string_view before, std::string_view after) {
  const std::vector<std::string_view> a = lang::lines_of(before), b = lang::lines_of(after);
  const std::vector<LineChange> changes = lang::changed_lines(a, b);
  if (changes.empty()) return {};
  std::string diff = fmt::format("--- {0}\n+++ {0}\n", shown_name(name));
  for (std::size_t first = 0; first < changes.size();) {
    std::size_t last = first;
    while (last + 1 < changes.size() &&
           changes[last + 1].a_begin - changes[last].a_end <= 2 * kContext) {
      ++last;
    }
    append_hunk(diff, a, b, &changes[first], &changes[last]);
    first = last + 1;
  }
  return diff;
}

}  // namespace sdlc::cli
