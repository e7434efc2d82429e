#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sdlc::lang {

/// How well a query matches a name, higher is better; nullopt if its characters are not all in the
/// name, in this order, whatever their case. Adjacent characters, beginnings of words and equal
/// case count. An empty query matches every name.
std::optional<int> match_score(std::string_view query, std::string_view name);

/// The best matches among many names.
class SymbolSearch {
 public:
  SymbolSearch(std::string query, std::size_t max_count)
      : query_(std::move(query)), max_count_(max_count) {}

  /// `key`: what `best()` returns for the name.
  void add(std::string_view name, std::uint64_t key);
  /// The keys of the best matches, best first; of equal ones in the order in which they were added.
  std::vector<std::uint64_t> best();

 private:
  struct Match {
    int score = 0;
    std::uint64_t order = 0, key = 0;
  };

  static bool is_better(const Match& a, const Match& b) noexcept;

  std::string query_;
  std::size_t max_count_;
  std::uint64_t added_ = 0;
  std::vector<Match> heap_;  // the worst match is first
};

}  // namespace sdlc::lang
