#include "lang/editor/symbol_search.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

using namespace lang;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> found(std::string query, const std::vector<std::string>& names,
                               std::size_t max_count = 100) {
  SymbolSearch search(std::move(query), max_count);
  for (std::size_t i = 0; i < names.size(); ++i) search.add(names[i], i);
  std::vector<std::string> best;
  for (const std::uint64_t key : search.best()) best.push_back(names[key]);
  return best;
}

TEST(SymbolSearch, FindsSubsequencesInAnyCase) {
  EXPECT_THAT(found("rg", {"ring", "big_ring", "grid", "RG"}),
              ElementsAre("RG", "ring", "big_ring"));
  EXPECT_FALSE(match_score("gr", "ring"));
  EXPECT_FALSE(match_score("rings", "ring"));
  EXPECT_TRUE(match_score("RING", "ring"));
}

TEST(SymbolSearch, PrefersWholeNamesBeginningsAndAdjacentLetters) {
  EXPECT_THAT(found("ring", {"string", "ring_big", "r_i_n_g", "ring", "big_ring"}),
              ElementsAre("ring", "ring_big", "big_ring", "string", "r_i_n_g"));
  EXPECT_THAT(found("bm", {"album", "brushed_metal"}), ElementsAre("brushed_metal", "album"));
}

TEST(SymbolSearch, KeepsTheBest) {
  EXPECT_THAT(found("a", {"ba", "ca", "a", "da"}, 2), ElementsAre("a", "ba"));
  EXPECT_THAT(found("", {"b", "a", "c"}, 2), ElementsAre("b", "a"));
  EXPECT_THAT(found("x", {"a"}), IsEmpty());
  EXPECT_THAT(found("a", {"a"}, 0), IsEmpty());
  EXPECT_THAT(found("a", {""}), IsEmpty());
  EXPECT_THAT(found("aa", {std::string(100'000, 'a')}).size(), 1u);
}

}  // namespace
}  // namespace sdlc::test
