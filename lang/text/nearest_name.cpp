#include "lang/text/nearest_name.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <fmt/format.h>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {
namespace {

constexpr std::size_t kMaxNameSize = 64;  ///< the bits of a word: one per character

/// The row of a character in a table that ignores case.
constexpr unsigned char row_of(char c) noexcept { return static_cast<unsigned char>(to_lower(c)); }

bool starts_with(std::string_view text, std::string_view begin) noexcept {
  return text.size() >= begin.size() &&
         std::equal(begin.begin(), begin.end(), text.begin(),
                    [](char a, char b) { return to_lower(a) == to_lower(b); });
}

/// Damerau-Levenshtein distances from one name to others ("optimal string alignment", case
/// ignored), by Hyyro's bit-vector algorithm: a column of the table takes a few operations on one
/// word. H. Hyyro, A bit-vector algorithm for computing Levenshtein and Damerau edit distances,
/// 2003.
class EditDistance {
 public:
  /// Precondition: 1 to kMaxNameSize characters.
  explicit EditDistance(std::string_view name) noexcept
      : size_(name.size()), last_(std::uint64_t{1} << (name.size() - 1)) {
    for (std::size_t i = 0; i < name.size(); ++i) {
      places_[row_of(name[i])] |= std::uint64_t{1} << i;
    }
  }

  std::size_t to(std::string_view other) const noexcept {
    // One bit per row: whether the distance is larger or smaller than in the row above.
    std::uint64_t rises = ~std::uint64_t{0}, falls = 0;
    std::uint64_t diagonal = 0, places_before = 0;
    std::size_t distance = size_;
    for (const char c : other) {
      const std::uint64_t places = places_[row_of(c)];
      const std::uint64_t swapped = ((~diagonal & places) << 1) & places_before;
      diagonal = (((places & rises) + rises) ^ rises) | places | falls | swapped;
      std::uint64_t grows = falls | ~(diagonal | rises);
      std::uint64_t shrinks = diagonal & rises;
      distance += (grows & last_) != 0 ? 1 : 0;
      distance -= (shrinks & last_) != 0 ? 1 : 0;
      grows = (grows << 1) | 1;
      shrinks <<= 1;
      rises = shrinks | ~(diagonal | grows);
      falls = grows & diagonal;
      places_before = places;
    }
    return distance;
  }

 private:
  std::size_t size_;
  std::uint64_t last_;  ///< the bit of the last row
  std::array<std::uint64_t, 256> places_{};
};

/// A third of the length. Names of one or two letters get one edit if there are few candidates:
/// with many, any such name is one edit from some candidate.
constexpr std::size_t max_edits(std::size_t size, std::size_t names) noexcept {
  constexpr std::size_t kFewNames = 16;
  return std::max<std::size_t>(size / 3, names <= kFewNames ? 1 : 0);
}

}  // namespace

std::optional<std::string_view> nearest_name(std::string_view name,
                                             std::span<const std::string_view> candidates) {
  if (name.empty() || name.size() > kMaxNameSize) return std::nullopt;
  const EditDistance distance_from_name(name);
  std::optional<std::string_view> best;
  std::size_t best_distance = 0;
  for (const std::string_view candidate : candidates) {
    if (candidate.size() > kMaxNameSize || candidate == name) continue;
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    const std::size_t allowed = max_edits(longer, candidates.size());
    const bool is_part =
        shorter >= 3 && (starts_with(name, candidate) || starts_with(candidate, name));
    if (!is_part && longer - shorter > allowed) continue;
    std::size_t distance = distance_from_name.to(candidate);
    if (is_part) distance = std::min(distance, allowed);
    if (distance > allowed) continue;
    if (!best || distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> candidates) {
  const auto nearest = nearest_name(name, candidates);
  return nearest ? fmt::format(" (did you mean `{}`?)", *nearest) : std::string();
}

}  // namespace sdlc::lang
