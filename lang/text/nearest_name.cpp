#include "lang/text/nearest_name.hpp"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace sdlc::lang {
namespace {

std::string lower_case(std::string_view text) {
  std::string lower(text);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return lower;
}

/// Damerau-Levenshtein distance with adjacent transpositions ("optimal string alignment").
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, change});
      const bool swapped =
          i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] && a[i - 1] != b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, row);
  }
  return last[b.size()];
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates) {
  constexpr std::size_t kLongestName = 64;  // the distance is quadratic; longer names are not typos
  if (name.empty() || name.size() > kLongestName) return std::nullopt;

  const std::string wanted = lower_case(name);
  std::optional<std::string_view> best;
  std::size_t best_distance = 0;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kLongestName) continue;
    const std::string other = lower_case(candidate);
    const std::size_t allowed = (std::max(wanted.size(), other.size()) + 2) / 3;
    std::size_t distance = edit_distance(wanted, other);
    const bool is_part = std::min(wanted.size(), other.size()) >= 3 &&
                         (wanted.starts_with(other) || other.starts_with(wanted));
    if (is_part) distance = std::min(distance, allowed);
    if (distance > allowed) continue;
    if (!best || distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

}  // namespace sdlc::lang
