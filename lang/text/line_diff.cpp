#include "lang/text/line_diff.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace sdlc::lang {
namespace {

using Lines = std::span<const std::string_view>;

/// Pairs of equal lines, both ascending.
using Matches = std::vector<std::pair<std::size_t, std::size_t>>;

/// Finds unchanged lines by Cohen's patience diff: lines that occur once in each text are anchors,
/// as long as they keep their order, and the text between two anchors is compared in the same way.
class Matcher {
 public:
  Matcher(Lines a, Lines b) : a_(a), b_(b) {}

  Matches run() {
    std::vector<LineChange> todo{{0, a_.size(), 0, b_.size()}};
    while (!todo.empty()) {
      LineChange stretch = todo.back();
      todo.pop_back();
      trim(stretch);
      if (stretch.a_begin == stretch.a_end || stretch.b_begin == stretch.b_end) continue;
      const Matches anchors = anchors_of(stretch);
      if (anchors.empty()) {
        match_few(stretch);
      } else {
        divide(stretch, anchors, todo);
      }
    }
    std::ranges::sort(matches_);
    return std::move(matches_);
  }

 private:
  /// Matches the lines at both ends.
  void trim(LineChange& s) {
    while (s.a_begin < s.a_end && s.b_begin < s.b_end && a_[s.a_begin] == b_[s.b_begin]) {
      matches_.emplace_back(s.a_begin++, s.b_begin++);
    }
    while (s.a_begin < s.a_end && s.b_begin < s.b_end && a_[s.a_end - 1] == b_[s.b_end - 1]) {
      matches_.emplace_back(--s.a_end, --s.b_end);
    }
  }

  Matches anchors_of(const LineChange& s) const {
    struct Places {
      std::size_t a = 0, b = 0, count_a = 0, count_b = 0;
    };
    std::unordered_map<std::string_view, Places> places;
    for (std::size_t i = s.a_begin; i < s.a_end; ++i) {
      Places& place = places[a_[i]];
      place.a = i, ++place.count_a;
    }
    for (std::size_t i = s.b_begin; i < s.b_end; ++i) {
      Places& place = places[b_[i]];
      place.b = i, ++place.count_b;
    }
    Matches unique;
    for (const auto& [line, place] : places) {
      if (place.count_a == 1 && place.count_b == 1) unique.emplace_back(place.a, place.b);
    }
    std::ranges::sort(unique);
    return longest_rising(unique);
  }

  /// The longest subsequence with ascending second numbers.
  static Matches longest_rising(const Matches& pairs) {
    std::vector<std::size_t> ends;  // last pair of the best sequence of each length
    std::vector<std::size_t> before(pairs.size());
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const auto at = std::ranges::lower_bound(ends, pairs[i].second, {},
                                               [&](std::size_t end) { return pairs[end].second; });
      before[i] = at == ends.begin() ? i : *(at - 1);
      if (at == ends.end()) {
        ends.push_back(i);
      } else {
        *at = i;
      }
    }
    Matches longest(ends.size());
    for (std::size_t n = ends.size(), i = ends.empty() ? 0 : ends.back(); n > 0; i = before[i]) {
      longest[--n] = pairs[i];
    }
    return longest;
  }

  void divide(const LineChange& s, const Matches& anchors, std::vector<LineChange>& todo) {
    std::size_t a = s.a_begin, b = s.b_begin;
    for (const auto& [at_a, at_b] : anchors) {
      todo.push_back({a, at_a, b, at_b});
      matches_.emplace_back(at_a, at_b);
      a = at_a + 1, b = at_b + 1;
    }
    todo.push_back({a, s.a_end, b, s.b_end});
  }

  /// Longest common subsequence by dynamic programming, if the table is small.
  void match_few(const LineChange& s) {
    constexpr std::size_t kLargestTable = 1'000'000;
    const std::size_t rows = s.a_end - s.a_begin, columns = s.b_end - s.b_begin;
    if (rows >= kLargestTable / columns) return;
    std::vector<std::uint32_t> table((rows + 1) * (columns + 1));
    const auto longest = [&](std::size_t i, std::size_t j) -> std::uint32_t& {
      return table[i * (columns + 1) + j];
    };
    const auto is_same = [&](std::size_t i, std::size_t j) {
      return a_[s.a_begin + i] == b_[s.b_begin + j];
    };
    for (std::size_t i = rows; i-- > 0;) {
      for (std::size_t j = columns; j-- > 0;) {
        longest(i, j) = is_same(i, j) ? longest(i + 1, j + 1) + 1
                                      : std::max(longest(i + 1, j), longest(i, j + 1));
      }
    }
    for (std::size_t i = 0, j = 0; i < rows && j < columns;) {
      if (is_same(i, j)) {
        matches_.emplace_back(s.a_begin + i++, s.b_begin + j++);
      } else {
        ++(longest(i + 1, j) >= longest(i, j + 1) ? i : j);
      }
    }
  }

  Lines a_, b_;
  Matches matches_;
};

}  // namespace

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::size_t size = end == std::string_view::npos ? text.size() : end + 1;
    lines.push_back(text.substr(0, size));
    text.remove_prefix(size);
  }
  return lines;
}

std::vector<LineChange> changed_lines(Lines a, Lines b) {
  Matches matches = Matcher(a, b).run();
  matches.emplace_back(a.size(), b.size());
  std::vector<LineChange> changes;
  std::size_t at_a = 0, at_b = 0;
  for (const auto& [a_match, b_match] : matches) {
    if (a_match > at_a || b_match > at_b) changes.push_back({at_a, a_match, at_b, b_match});
    at_a = a_match + 1, at_b = b_match + 1;
  }
  return changes;
}

}  // namespace sdlc::lang
