#include "lang/lint_config/glob.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

bool matches(const char* pattern, const char* path) { return Glob(pattern).matches(path); }

TEST(Glob, WithoutASlashIsAboutNamesAtAnyDepth) {
  EXPECT_TRUE(matches("*.json", "a.json"));
  EXPECT_TRUE(matches("*.json", "old/deep/a.json"));
  EXPECT_FALSE(matches("*.json", "a.json/b.scene"));
}

TEST(Glob, WithASlashIsAPathFromTheFolder) {
  EXPECT_TRUE(matches("old/*.json", "old/a.json"));
  EXPECT_FALSE(matches("old/*.json", "new/old/a.json"));
  EXPECT_FALSE(matches("old/*.json", "old/deep/a.json"));
}

TEST(Glob, TakesAnyNumberOfFoldersForTwoStars) {
  EXPECT_TRUE(matches("library/**", "library/a.scene"));
  EXPECT_TRUE(matches("library/**", "library/b/c/a.scene"));
  EXPECT_FALSE(matches("library/**", "a/library/a.scene"));
  EXPECT_TRUE(matches("**/test/*.scene", "test/a.scene"));
  EXPECT_TRUE(matches("**/test/*.scene", "a/b/test/a.scene"));
  EXPECT_TRUE(matches("a/**/z/**/b", "a/x/z/y/z/b"));
  EXPECT_FALSE(matches("a/**/z/**/b", "a/x/b"));
  EXPECT_TRUE(matches("**", "a/b"));
}

TEST(Glob, TakesAllOfAFolderForASlashAtItsEnd) {
  EXPECT_TRUE(matches("library/", "library/b/a.scene"));
  EXPECT_FALSE(matches("library/", "libraries/a.scene"));
}

TEST(Glob, KnowsStarsQuestionMarksAndSets) {
  EXPECT_TRUE(matches("a*b*c", "aXbYbc"));
  EXPECT_FALSE(matches("a*b*c", "aXbYb"));
  EXPECT_TRUE(matches("a?c", "abc"));
  EXPECT_FALSE(matches("a?c", "ac"));
  EXPECT_TRUE(matches("[a-c1]x", "bx"));
  EXPECT_FALSE(matches("[a-c1]x", "dx"));
  EXPECT_TRUE(matches("[!a-c]x", "dx"));
  EXPECT_FALSE(matches("[!a-c]x", "ax"));
  EXPECT_TRUE(matches("[]]x", "]x"));
  EXPECT_TRUE(matches("[a-]x", "-x"));
}

TEST(Glob, IsQuickForManyStars) {
  EXPECT_FALSE(matches("*a*a*a*a*a*a*a*a*a*a*a*b",
                       "aaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa"));
  EXPECT_FALSE(matches("**/a/**/a/**/a/**/a/**/a/**/a/**/a/**/a/**/b",
                       "a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a/a"));
}

TEST(Glob, RejectsInvalidPatterns) {
  for (const char* pattern : {"", "/", "/a", "a//b", "../a", "./a", "a/**b", "[a", "[]", "a\\b"}) {
    EXPECT_THROW(Glob{pattern}, std::invalid_argument) << pattern;
  }
}

}  // namespace
}  // namespace sdlc::lang
