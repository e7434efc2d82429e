#include <algorithm>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <tao/pegtl/contrib/analyze.hpp>

#include "grammar/scene.hpp"

namespace sdlc::grammar {
namespace {

std::string read(const std::string& path) {
  std::ifstream file(std::string(SDLC_SOURCE_DIR) + "/" + path);
  EXPECT_TRUE(file) << path;
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// The first group of every match, in order.
std::vector<std::string> find_all(const std::string& text, const char* pattern) {
  const std::regex regex(pattern);
  std::vector<std::string> found;
  for (std::sregex_iterator i(text.begin(), text.end(), regex), end; i != end; ++i) {
    found.push_back((*i)[1]);
  }
  return found;
}

/// The syntactic rules, then the lexical ones.
std::string grammar_text() { return read("grammar/scene.hpp") + read("grammar/scene_tokens.hpp"); }

std::vector<std::string> ebnf_names() {
  return find_all(read("grammar/scene.ebnf"), "\n(\\w+) += ");
}

/// The rules that are defined, in order; one that would be a word of C++ without it has a `_`
/// behind its name.
std::vector<std::string> rule_names() { return find_all(grammar_text(), "\nstruct (\\w+?)_? *: "); }

TEST(SceneGrammar, HasNoRuleThatLoopsWithoutProgress) {
  EXPECT_EQ(tao::pegtl::analyze<file>(), 0u);
}

TEST(SceneGrammar, NamesTheSameThingsAsTheEbnfInTheSameOrder) {
  const auto names = ebnf_names();
  ASSERT_GT(names.size(), 50u);
  const std::set<std::string> in_ebnf(names.begin(), names.end());
  std::vector<std::string> rules;
  for (const std::string& rule : rule_names()) {
    if (in_ebnf.contains(rule)) rules.push_back(rule);
  }
  EXPECT_EQ(rules, names);
}

TEST(SceneGrammar, NamesPartsAfterTheirProduction) {
  const auto names = ebnf_names();
  const std::set<std::string> templates{"token", "text", "mark", "word"};
  for (const std::string& rule : rule_names()) {
    if (templates.contains(rule)) continue;
    const bool is_part = rule.ends_with("_word") ||
                         std::any_of(names.begin(), names.end(), [&](const std::string& name) {
                           return rule == name || rule.starts_with(name + "_");
                         });
    EXPECT_TRUE(is_part) << rule;
  }
}

TEST(SceneGrammar, HasWordsForExactlyTheRulesItCommitsTo) {
  std::set<std::string> committed;
  for (const std::string& rules : find_all(grammar_text(), "must<([^<>]*)>")) {
    for (const std::string& rule : find_all(rules, "(\\w+)")) committed.insert(rule);
  }
  std::set<std::string> worded;
  for (const std::string& rule :
       find_all(read("lang/syntax/expected.hpp"), "SDLC_EXPECTED\\((\\w+), [^.]")) {
    worded.insert(rule);
  }
  ASSERT_GT(committed.size(), 40u);
  EXPECT_EQ(committed, worded);
}

bool matches(std::string_view text) {
  tao::pegtl::memory_input<tao::pegtl::tracking_mode::lazy, tao::pegtl::eol::lf> in(
      text.data(), text.data() + text.size(), "");
  try {
    return tao::pegtl::parse<file>(in);
  } catch (const tao::pegtl::parse_error&) {
    return false;
  }
}

TEST(SceneGrammar, TellsNumbersFromWhatOnlyLooksLikeThem) {
  const auto is_number = [](const std::string& text) { return matches("scene 1 let a = " + text); };
  for (const char* number :
       {"1", "1.5", ".5", "1e3", "1E-3", "1_000", "50%", "40deg", "2mm", "1 .. 48", "1..48"}) {
    EXPECT_TRUE(is_number(number)) << number;
  }
  for (const char* other :
       {"1.", "1.e3", "1__0", "1_", "0x10", "5min", "50%b", "1.2.3", "1e", "2 m", "1e5e5"}) {
    EXPECT_FALSE(is_number(other)) << other;
  }
}

TEST(SceneGrammar, TakesReservedWordsForLabelsButNotForNames) {
  EXPECT_TRUE(matches("scene 1 sphere { for: 1, let: f(if: 2) }"));
  EXPECT_FALSE(matches("scene 1 let for = 1"));
  EXPECT_FALSE(matches("scene 1 sphere not { }"));
  EXPECT_TRUE(matches("scene 1 let format = notes + iffy + trueish"));
}

TEST(SceneGrammar, TakesLocalNamesWhereAnExpressionStarts) {
  EXPECT_TRUE(matches("scene 1 let a = let b = 1, c = b in b + c"));
  EXPECT_TRUE(matches("scene 1 for in in let n = 3 in range(n) { }"));
  EXPECT_FALSE(matches("scene 1 let a = 1 + let b = 1 in b"));
  EXPECT_FALSE(matches("scene 1 let a = let b = 1, in b"));
}

TEST(SceneGrammar, NeverTakesALabelForAValue) {
  EXPECT_FALSE(matches("scene 1 sphere { center:\nradius: 1 }"));
}

TEST(SceneGrammar, LetsNewlinesAndCommentsStandAnywhereBetweenTokens) {
  EXPECT_TRUE(
      matches("// c\nscene/**/1\n\n sphere\n\n{\ncenter\n:\n(\n1\n,/* /* */ */2,\r\n3\n)\n}"));
  EXPECT_TRUE(matches("scene 1 let a = f\n(1)\n[0]\n.x"));
  EXPECT_FALSE(matches("scene 1 let a = 1\n[0]"));
}

TEST(SceneGrammar, ComparesOnce) {
  EXPECT_TRUE(matches("scene 1 let a = b < c and c <= d"));
  EXPECT_FALSE(matches("scene 1 let a = b < c < d"));
}

}  // namespace
}  // namespace sdlc::grammar
