#include <string_view>

#include <gtest/gtest.h>
#include <tao/pegtl/contrib/analyze.hpp>
#include <tao/pegtl/memory_input.hpp>
#include <tao/pegtl/parse.hpp>

#include "grammar/json.hpp"

namespace sdlc::grammar::json {
namespace {

TEST(JsonGrammar, NoRuleCanLoopWithoutConsuming) { EXPECT_EQ(pegtl::analyze<text>(), 0u); }

template <typename Rule>
bool matches(std::string_view input) {
  pegtl::memory_input in(input, "");
  return pegtl::parse<pegtl::seq<Rule, eof>>(in);
}

TEST(JsonGrammar, NumbersAreThoseOfTheStandard) {
  for (const char* good : {"0", "-0", "10", "-1.5", "1e3", "1E+3", "0.5e-10"}) {
    EXPECT_TRUE(matches<number>(good)) << good;
  }
  for (const char* bad : {"", "-", "01", "+1", ".5", "1.", "1e", "0x1", "1_0", "NaN"}) {
    EXPECT_FALSE(matches<number>(bad)) << bad;
  }
}

TEST(JsonGrammar, EscapesAreThoseOfTheStandard) {
  for (const char* good : {R"(\n)", R"(\u00e9)", R"(\ud83d\ude00)", R"(\/)"}) {
    EXPECT_TRUE(matches<escape>(good)) << good;
  }
  for (const char* bad : {R"(\x)", R"(\u12)", R"(\ud83d)", R"(\ude00)", R"(\ud83d\ud83d)"}) {
    EXPECT_FALSE(matches<escape>(bad)) << bad;
  }
}

}  // namespace
}  // namespace sdlc::grammar::json
