#include "lang/editor/symbol_search.hpp"

#include <algorithm>
#include <limits>

#include "lang/text/ascii.hpp"

namespace sdlc::lang {
namespace {

constexpr int kNoMatch = std::numeric_limits<int>::min() / 2;
constexpr int kAdjacent = 10, kWordBegin = 6, kNameBegin = 4, kSameCase = 1, kMatch = 4;
constexpr int kWholeName = 20;
/// Longer names are compared only so far.
constexpr std::size_t kMaxCompared = 256;

bool is_word_begin(std::string_view name, std::size_t at) {
  if (at == 0) return true;
  const char before = name[at - 1];
  const bool is_camel = to_lower(before) == before && to_lower(name[at]) != name[at];
  return before == '_' || before == '.' || is_camel;
}

}  // namespace

std::optional<int> match_score(std::string_view query, std::string_view name) {
  const std::string_view compared = name.substr(0, kMaxCompared);
  if (query.size() > compared.size()) return std::nullopt;
  // ends[j]: the best score of a match of the first i characters whose last one is name[j - 1].
  // before[j]: the best one within the first j characters.
  std::vector<int> before(compared.size() + 1, 0), ends(compared.size() + 1, kNoMatch);
  for (const char wanted : query) {
    std::vector<int> next_before(compared.size() + 1, kNoMatch);
    std::vector<int> next_ends(compared.size() + 1, kNoMatch);
    for (std::size_t j = 1; j <= compared.size(); ++j) {
      const char c = compared[j - 1];
      next_before[j] = next_before[j - 1];
      if (to_lower(c) != to_lower(wanted)) continue;
      const int best = std::max(before[j - 1], ends[j - 1] + kAdjacent);
      if (best < 0) continue;
      next_ends[j] = best + kMatch + (c == wanted ? kSameCase : 0) +
                     (is_word_begin(compared, j - 1) ? kWordBegin : 0) + (j == 1 ? kNameBegin : 0);
      next_before[j] = std::max(next_before[j], next_ends[j]);
    }
    before = std::move(next_before);
    ends = std::move(next_ends);
  }
  const int score = before.back();
  if (score < 0) return std::nullopt;
  return score + (query.size() == name.size() ? kWholeName : 0);
}

bool SymbolSearch::is_better(const Match& a, const Match& b) noexcept {
  return a.score != b.score ? a.score > b.score : a.order < b.order;
}

void SymbolSearch::add(std::string_view name, std::uint64_t key) {
  const auto score = match_score(query_, name);
  if (!score) return;
  heap_.push_back({.score = *score, .order = added_++, .key = key});
  std::ranges::push_heap(heap_, is_better);
  if (heap_.size() <= max_count_) return;
  std::ranges::pop_heap(heap_, is_better);
  heap_.pop_back();
}

std::vector<std::uint64_t> SymbolSearch::best() {
  std::ranges::sort(heap_, is_better);
  std::vector<std::uint64_t> keys;
  for (const Match& match : heap_) keys.push_back(match.key);
  heap_.clear();
  return keys;
}

}  // namespace sdlc::lang
