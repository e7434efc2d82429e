#include "lang/editor/semantic_tokens.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using lang::SemanticToken;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;

/// "text type modifier…"
std::string describe(const SemanticToken& token, std::string_view text) {
  std::string line(text.substr(token.span.begin, token.span.size()));
  line += ' ';
  line += lang::kSemanticTypeNames[static_cast<std::size_t>(token.type)];
  for (std::size_t bit = 0; bit < lang::kSemanticModifierNames.size(); ++bit) {
    if ((token.modifiers >> bit & 1) != 0) {
      line += ' ';
      line += lang::kSemanticModifierNames[bit];
    }
  }
  return line;
}

std::vector<std::string> tokens_of(std::map<std::string, std::string> texts,
                                   std::optional<lang::Span> range = std::nullopt) {
  MarkedScene scene(std::move(texts));
  std::vector<std::string> lines;
  for (const SemanticToken& token : lang::semantic_tokens(scene.view(), scene.file(), range)) {
    lines.push_back(describe(token, scene.text(scene.file())));
  }
  return lines;
}

std::vector<std::string> tokens_of(const std::string& text) {
  return tokens_of({{"root.scene", text}});
}

/// The tokens after `scene 1`.
std::vector<std::string> tokens_in(const std::string& text) {
  auto lines = tokens_of("scene 1\n" + text);
  lines.erase(lines.begin(), lines.begin() + 2);
  return lines;
}

TEST(SemanticTokens, AreWordsNumbersAndOperators) {
  EXPECT_THAT(
      tokens_of("scene 1 let a = if true then -2e3 else \"x\" .. #fc0\n"),
      ElementsAre("scene keyword", "1 number", "let keyword", "a variable declaration readonly",
                  "= operator", "if keyword", "true keyword", "then keyword", "- operator",
                  "2e3 number", "else keyword", "\"x\" string", ".. operator", "#fc0 number"));
}

TEST(SemanticTokens, TellObjectsPropertiesAndWordsApart) {
  EXPECT_THAT(tokens_in("camera main { up: v.x }\nrender { tone: sqrt, camera: main }\n"),
              ElementsAre("camera type defaultLibrary", "main label declaration",
                          "up property defaultLibrary", "x property", "render type defaultLibrary",
                          "tone property defaultLibrary", "sqrt enumMember defaultLibrary",
                          "camera property defaultLibrary", "main label"));
}

TEST(SemanticTokens, OfDefinitionsAndTheirParameters) {
  EXPECT_THAT(
      tokens_in("def ring(n: number = 1) {}\nring { n: 2 }\n"),
      ElementsAre("def keyword", "ring class declaration", "n parameter declaration readonly",
                  "number type defaultLibrary", "= operator", "1 number", "ring class",
                  "n property readonly", "2 number"));
  EXPECT_THAT(
      tokens_in("fn f(x) = f(x: x)\n"),
      ElementsAre("fn keyword", "f function declaration", "x parameter declaration readonly",
                  "= operator", "f function", "x parameter readonly", "x parameter readonly"));
}

TEST(SemanticTokens, OfTheLanguageAreMarkedAsSuch) {
  EXPECT_THAT(tokens_in("let a = [diffuse(color: red), sqrt(pi), rgb(r: time)]\n"),
              ElementsAre("let keyword", "a variable declaration readonly", "= operator",
                          "diffuse struct defaultLibrary", "color parameter defaultLibrary",
                          "red variable readonly defaultLibrary", "sqrt function defaultLibrary",
                          "pi variable readonly defaultLibrary", "rgb function defaultLibrary",
                          "r parameter defaultLibrary", "time variable readonly defaultLibrary"));
}

TEST(SemanticTokens, OfImportsAndLoops) {
  EXPECT_THAT(
      tokens_of({{"root.scene", "scene 1\nimport \"l\" as l\nfor in in l.all {}|\n"},
                 {"l", "scene 1\nlet all = [1]\n"}}),
      ElementsAre("scene keyword", "1 number", "import keyword", "\"l\" string", "as keyword",
                  "l namespace declaration", "for keyword", "in variable declaration readonly",
                  "in keyword", "l namespace", "all variable readonly"));
}

TEST(SemanticTokens, OfCommentsAreInOneLine) {
  EXPECT_THAT(tokens_in("/// Doc.\r\n/* a\r\n\r\n  b\rc */ // d"),
              ElementsAre("/// Doc. comment documentation", "/* a comment", "  b comment",
                          "c */ comment", "// d comment"));
}

TEST(SemanticTokens, OmitNamesWithoutAMeaning) {
  EXPECT_THAT(tokens_in("sphere { radus: unknown }\n"), ElementsAre("sphere type defaultLibrary"));
  EXPECT_THAT(tokens_in("sphere { if: 1 }\n"), Not(Contains("if keyword")));
}

TEST(SemanticTokens, OfARangeAreThoseThatOverlapIt) {
  const std::string text = "scene 1\nlet a = 1\nlet b = v. /**/ x.y\n/* x\ny */\nlet v = 3\n";
  for (std::uint32_t begin = 0; begin <= text.size(); ++begin) {
    for (std::uint32_t end = begin; end <= text.size() + 2; ++end) {
      MarkedScene scene(text);
      std::vector<SemanticToken> wanted;
      for (const SemanticToken& token : lang::semantic_tokens(scene.view(), 0)) {
        if (token.span.begin < end && token.span.end > begin) wanted.push_back(token);
      }
      EXPECT_EQ(lang::semantic_tokens(scene.view(), 0, lang::Span{begin, end}), wanted)
          << begin << " " << end;
    }
  }
}

TEST(SemanticTokens, OfBrokenTextsAreSortedAndApart) {
  const std::string text =
      "\xEF\xBB\xBFscene 1\nlet = 3 + sphere { radius 1 \"x\n for i in { /* let a\n = b #zz \x01 é";
  for (std::size_t size = 0; size <= text.size(); ++size) {
    MarkedScene scene(text.substr(0, size));
    std::uint32_t end = 0;
    for (const SemanticToken& token : lang::semantic_tokens(scene.view(), 0)) {
      EXPECT_GE(token.span.begin, end);
      EXPECT_GT(token.span.end, token.span.begin);
      end = token.span.end;
    }
    EXPECT_LE(end, size);
  }
}

}  // namespace
}  // namespace sdlc::test
