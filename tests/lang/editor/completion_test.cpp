#include "lang/editor/completion.hpp"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::IsSupersetOf;
using testing::Not;

std::vector<lang::FolderEntry> no_files(const std::filesystem::path& /*folder*/) { return {}; }

lang::CompletionList completions(MarkedScene scene) {
  return lang::complete(scene.view(), scene.file(), scene.offset(), no_files);
}

std::vector<std::string> labels(const lang::CompletionList& list) {
  std::vector<std::string> all;
  for (const auto& item : list.items) all.push_back(item.label);
  return all;
}

std::vector<std::string> labels(std::string_view text) {
  return labels(completions(MarkedScene(text)));
}

std::vector<std::string> labels(std::map<std::string, std::string> texts) {
  return labels(completions(MarkedScene(std::move(texts))));
}

lang::CompletionItem item(std::string_view text, std::string_view label) {
  for (auto& found : completions(MarkedScene(text)).items) {
    if (found.label == label) return found;
  }
  ADD_FAILURE() << "no item " << label;
  return {};
}

TEST(Completion, OffersNothingInCommentsStringsAndNumbers) {
  EXPECT_THAT(labels("scene 1\n// sp|"), IsEmpty());
  EXPECT_THAT(labels("scene 1\n/* sp| */"), IsEmpty());
  EXPECT_THAT(labels("scene 1\n/* sp|"), IsEmpty());
  EXPECT_THAT(labels("scene 1\n/// sp|\nlet a = 1"), IsEmpty());
  EXPECT_THAT(labels("scene 1\nlet a = \"sp|here\""), IsEmpty());
  EXPECT_THAT(labels("scene 1\nlet a = \"sp|"), IsEmpty());
  EXPECT_THAT(labels("scene 1\nlet a = 12|34"), IsEmpty());
  EXPECT_THAT(labels("scene 1\nsphere { radius: 1.|"), IsEmpty());
}

TEST(Completion, OffersNothingForNewNames) {
  for (const char* text : {"let |", "let a|", "param |", "fn |", "def |", "for |", "fn f(|",
                           "def d(a: number, |", "sphere |", "sphere b|", "let a |"}) {
    EXPECT_THAT(labels(std::string("scene 1\n") + text), IsEmpty()) << text;
  }
}

TEST(Completion, ReplacesTheWholeWord) {
  const auto found = item("scene 1\nsphere { ra|dus: 1 }", "radius");
  EXPECT_EQ(found.replaced, (lang::Span{17, 22}));
  // The colon is there already.
  EXPECT_EQ(found.text, "radius");
  EXPECT_EQ(found.snippet, "");
  EXPECT_EQ(item("scene 1\nsphere { |ra }", "radius").replaced, (lang::Span{17, 17}));
}

TEST(Completion, KeepsWhatFollowsTheName) {
  EXPECT_EQ(item("scene 1\nlet a = nor|(1)", "normalize").snippet, "");
  EXPECT_EQ(item("scene 1\nlet a = nor|", "normalize").snippet, "normalize(${1:v})");
  EXPECT_EQ(item("scene 1\nsph| { }", "sphere").snippet, "");
}

TEST(Completion, OffersSettingsOnlyAtTheTopLevel) {
  EXPECT_THAT(labels("scene 1\n|"), IsSupersetOf({"camera", "render", "param", "fn", "def"}));
  const auto inside = labels("scene 1\ngroup {\n  |\n}");
  EXPECT_THAT(inside, IsSupersetOf({"sphere", "let", "for", "if", "include", "assert"}));
  for (const char* setting :
       {"camera", "background", "render", "animation", "param", "fn", "def", "import"}) {
    EXPECT_THAT(inside, Not(Contains(setting)));
  }
}

TEST(Completion, RanksASecondBackgroundLast) {
  const auto found = labels("scene 1\nbackground { color: white }\n|");
  EXPECT_EQ(found.back(), "background");
  EXPECT_EQ(labels("scene 1\nbackground { color: white }\nba|").front(), "background");
}

TEST(Completion, OmitsPropertiesThatAreGivenBeforeOrAfter) {
  EXPECT_THAT(labels("scene 1\nsphere { center: (0, 0, 0), |, material: m }"),
              ElementsAre("radius", "motion"));
  // Those of the next object do not count.
  EXPECT_THAT(labels("scene 1\nsphere { |\n\nsphere { center: (0, 0, 0), radius: 1 }"),
              IsSupersetOf({"center", "radius"}));
}

TEST(Completion, FindsTheBlockInBrokenTexts) {
  const std::vector<std::string> sphere{"center", "radius", "material", "motion"};
  for (const char* text :
       {"sphere {|", "sphere { |", "sphere {\n|", "sphere {\n  |", "group { sphere { |",
        "sphere {\n  |\n\ncamera main { fov: 40deg }", "for i in range(3) {\n  sphere { |\n}",
        "let a = (1, 2\nsphere { |", "sphere { ) |", "sphere { , |"}) {
    EXPECT_EQ(labels(std::string("scene 1\n") + text), sphere) << text;
  }
  // A line that is not indented more than an open block is outside of it.
  EXPECT_THAT(labels("scene 1\nsphere {\n  radius: 1\n\n|"), Contains("camera"));
}

TEST(Completion, OffersLocalsOfHalfTypedBlocks) {
  const auto found =
      labels("scene 1\nfor i in range(3) {\n  let a = i * 60deg\n  sphere { center: (cos(|");
  EXPECT_EQ(found.front(), "a");
  EXPECT_THAT(found, Contains("i"));
  EXPECT_THAT(labels("scene 1\ndef d(size: number) {\n  sphere { radius: |"), Contains("size"));
  EXPECT_THAT(labels("scene 1\nfn f(x: number) = |"), Contains("x"));
  EXPECT_THAT(labels("scene 1\nfor i in |"), Not(Contains("i")));
}

TEST(Completion, OmitsNamesThatAreNotVisible) {
  const auto found = labels("scene 1\nlet a = |\nlet b = 1\ngroup { let c = 1 }");
  EXPECT_THAT(found, Contains("b"));
  EXPECT_THAT(found, Not(Contains("a")));
  EXPECT_THAT(found, Not(Contains("c")));
  EXPECT_THAT(labels("scene 1\ngroup { let c = 1, let d = | }"), Contains("c"));
  EXPECT_THAT(labels("scene 1\nfn f(x, y = |) = x"), Contains("x"));
  EXPECT_THAT(labels("scene 1\nfn f(x, y = |) = x"), Not(Contains("y")));
}

TEST(Completion, RanksValuesByType) {
  const std::string names =
      "scene 1\nlet an = 40deg\nlet co = red\nlet ma = unlit(color: red)\nlet nu = 1\nlet ve = "
      "(1, 2, 3)\n";
  EXPECT_EQ(labels(names + "sphere { center: |").front(), "ve");
  EXPECT_EQ(labels(names + "sphere { radius: |").front(), "nu");
  EXPECT_EQ(labels(names + "sphere { material: |").front(), "ma");
  EXPECT_EQ(labels(names + "camera main { fov: |").front(), "an");
  EXPECT_EQ(labels(names + "background { top: |").front(), "co");
}

TEST(Completion, OffersMembersOfImports) {
  std::map<std::string, std::string> texts{
      {"lib.scene", "scene 1\nlet gold = unlit(color: red)\nlet size = 1\ndef ball(r) { }\n"}};
  const std::string start = "scene 1\nimport \"lib.scene\" as lib\n";
  texts["root.scene"] = start + "sphere { material: |";
  EXPECT_EQ(labels(texts).front(), "lib.gold");
  texts["root.scene"] = start + "sphere { radius: lib.|";
  EXPECT_THAT(labels(texts), ElementsAre("size", "gold"));
  texts["root.scene"] = start + "lib.|";
  EXPECT_THAT(labels(texts), ElementsAre("ball"));
  texts["root.scene"] = start + "lib.ball { |";
  EXPECT_THAT(labels(texts), ElementsAre("r", "translate", "rotate", "scale", "material"));
}

TEST(Completion, OffersNamedArgumentsThatAreMissing) {
  const auto found = labels("scene 1\nlet m = transmissive(|");
  EXPECT_THAT((std::vector(found.begin(), found.begin() + 3)),
              ElementsAre("ior:", "color:", "fresnel:"));
  EXPECT_THAT(labels("scene 1\nlet m = transmissive(ior: 1, |"), ElementsAre("color:", "fresnel:"));
  EXPECT_THAT(labels("scene 1\nlet m = transmissive(|, ior: 1)"), Not(Contains("ior:")));
  EXPECT_THAT(labels("scene 1\nlet m = transmissive(white, |"), Not(Contains("color:")));
  EXPECT_THAT(labels("scene 1\nlet m = transmissive(fresnel: |"), ElementsAre("schlick", "exact"));
}

TEST(Completion, OffersComponents) {
  EXPECT_THAT(labels("scene 1\nlet v = (1, 2, 3)\nlet a = v.|"), ElementsAre("x", "y", "z"));
  EXPECT_THAT(labels("scene 1\nlet v = 1\nlet a = v.|"), IsEmpty());
  EXPECT_THAT(labels("scene 1\nlet a = cross(b, c).|"), ElementsAre("x", "y", "z"));
}

TEST(Completion, OffersTheWordsOfConditionals) {
  EXPECT_EQ(labels("scene 1\nlet a = if b |").front(), "then");
  EXPECT_EQ(labels("scene 1\nlet a = (if b then 1 |)").front(), "else");
  EXPECT_EQ(labels("scene 1\nif b { }\n|").front(), "else");
  EXPECT_THAT(labels("scene 1\n|"), Not(Contains("else")));
  EXPECT_THAT(labels("scene 1\nfor i |"), ElementsAre("in"));
}

TEST(Completion, OffersTheWordsAndNamesOfComputedLists) {
  EXPECT_THAT(labels("scene 1\nlet a = [1 |]"), Contains("for"));
  EXPECT_THAT(labels("scene 1\nlet a = [1, 2 |]"), Not(Contains("for")));
  EXPECT_THAT(labels("scene 1\nlet a = [x for x |]"), ElementsAre("in"));
  EXPECT_EQ(labels("scene 1\nlet a = [x for x in |]").front(), "range");
  EXPECT_EQ(labels("scene 1\nlet a = [x for x in [1] |]").front(), "if");
  EXPECT_THAT(labels("scene 1\nlet a = [x for size in [1] if s|]"), Contains("size"));
  EXPECT_THAT(labels("scene 1\nlet a = [x for i, (size, _) in [[1, 2]] if s|]"), Contains("size"));
  EXPECT_THAT(labels("scene 1\nlet a = [x for size in [1]]\nlet b = s|"), Not(Contains("size")));
  EXPECT_THAT(labels("scene 1\nfor i, (size, _) in [[1, 2]] { let b = s| }"), Contains("size"));
}

TEST(Completion, OffersFilesRelativeToTheText) {
  std::vector<std::string> asked;
  const auto list = [&](const std::filesystem::path& folder) -> std::vector<lang::FolderEntry> {
    asked.push_back(folder.generic_string());
    return {{"b.scene"}, {"a.json"}, {"notes.txt"}, {".hidden.scene"}, {"sub", true}};
  };
  const auto complete = [&](std::string_view text) {
    MarkedScene scene(text);
    return lang::complete(scene.view(), scene.file(), scene.offset(), list);
  };
  EXPECT_THAT(labels(complete("scene 1\nimport \"|")), ElementsAre("b.scene", "sub/"));
  EXPECT_THAT(labels(complete("scene 1\ninclude \"lib/|\"")),
              ElementsAre("a.json", "b.scene", "sub/"));
  EXPECT_THAT(asked, ElementsAre("", "lib/"));
  EXPECT_EQ(complete("scene 1\nimport \"x/b|c.scene\" as b").items.front().replaced,
            (lang::Span{18, 26}));
  EXPECT_THAT(labels(complete("scene 1\nimport \"/|")), IsEmpty());
}

TEST(Completion, OffersDataFilesToImports) {
  const auto list = [](const std::filesystem::path& /*folder*/) {
    return std::vector<lang::FolderEntry>{{"a.csv"}, {"b.TSV"}, {"c.xyz"}, {"d.txt"}};
  };
  MarkedScene import("scene 1\nimport \"|"), include("scene 1\ninclude \"|");
  EXPECT_THAT(labels(lang::complete(import.view(), 0, import.offset(), list)),
              ElementsAre("a.csv", "b.TSV", "c.xyz"));
  EXPECT_THAT(labels(lang::complete(include.view(), 0, include.offset(), list)), IsEmpty());
}

TEST(Completion, OffersTheColumnsOfARow) {
  const std::string start = "scene 1\nimport \"a.csv\" as atoms\n";
  for (const char* text : {"for a in atoms { let b = a.| }", "let a = atoms[0]\nlet b = a.|"}) {
    EXPECT_THAT(labels({{"root.scene", start + text}, {"a.csv", "name,mass,\"x (m)\"\na,1,2\n"}}),
                ElementsAre("name", "mass"))
        << text;
  }
  EXPECT_THAT(labels({{"root.scene", start + "for a in at| {"}, {"a.csv", "x\n1\n"}}),
              Contains("atoms"));
}

TEST(Completion, OmitsTheFileItselfHoweverItIsNamed) {
  const auto list = [](const std::filesystem::path& /*folder*/) {
    return std::vector<lang::FolderEntry>{{"root.scene"}, {"b.scene"}};
  };
  for (const char* typed : {"", "./", "lib/../", ".//"}) {
    MarkedScene scene(std::string("scene 1\nimport \"") + typed + "|");
    EXPECT_THAT(labels(lang::complete(scene.view(), 0, scene.offset(), list)),
                ElementsAre("b.scene"))
        << typed;
  }
  MarkedScene scene("scene 1\nimport \"lib/|");
  EXPECT_THAT(labels(lang::complete(scene.view(), 0, scene.offset(), list)),
              ElementsAre("b.scene", "root.scene"));
}

TEST(Completion, OffersTheFolderAbove) {
  EXPECT_THAT(labels("scene 1\nimport \"..|"), ElementsAre("../"));
  EXPECT_THAT(labels("scene 1\nimport \"../..|\" as a"), ElementsAre("../"));
  EXPECT_THAT(labels("scene 1\nimport \"lib.|"), IsEmpty());
}

TEST(Completion, OffersColorsOfTheFileWhereAColorMayBe) {
  const std::string first = "scene 1\nlet a = #fc0\n";
  for (const char* text : {"let b = #|", "let b = #f|", "let b = [#fff, #|", "let b = a * #|",
                           "sphere { material: diffuse(#|", "background { top: #|",
                           "let b = if true then #|", "param c: color = #|"}) {
    EXPECT_THAT(labels(first + text), Contains("#fc0")) << text;
  }
  for (const char* text :
       {"#|", "#f|", "sphere { #|", "sphere #|", "let b = 1 #|", "let b = a #f|", "let #|",
        "sphere { radius: #|", "fn f(#|", "for i in #|", "sphere { material: #|", "if #|", "// #|",
        "/* #| */", "let b = \"#|\"", "import #|"}) {
    EXPECT_THAT(labels(first + text), IsEmpty()) << text;
  }
}

TEST(Completion, OffersCodesOfWarnings) {
  const auto found = labels("scene 1\n// sdlc: allow(|\nlet a = 1");
  EXPECT_THAT(found, Contains("W402"));
  EXPECT_THAT(found, Not(Contains("E104")));
  EXPECT_THAT(labels("scene 1\n// sdlc: allow(W402) W|"), IsEmpty());
}

TEST(Completion, OffersUnitsThatFit) {
  EXPECT_THAT(labels("scene 1\ncamera main { fov: 40|"), ElementsAre("40deg", "40turn", "40rad"));
  EXPECT_THAT(labels("scene 1\nsphere { radius: 2c|"), ElementsAre("2cm"));
  EXPECT_THAT(labels("scene 1\ncamera main { shutter: 0s .. 5|"), ElementsAre("5s", "5ms"));
}

TEST(Completion, BeginsAFileWithItsVersion) {
  EXPECT_THAT(labels("|"), ElementsAre("scene 1", "scene"));
  EXPECT_THAT(labels("\xEF\xBB\xBF|"), ElementsAre("scene 1", "scene"));
}

TEST(Completion, IsTheSameEachTime) {
  const std::string text = "scene 1\nlet b = 1\nlet a = 2\nsphere { radius: |";
  EXPECT_EQ(labels(text), labels(text));
  EXPECT_THAT((std::vector{labels(text)[0], labels(text)[1]}), ElementsAre("a", "b"));
}

TEST(Completion, AcceptsAnyNesting) {
  for (const char* bracket : {"(", "[", "{", "f(", "group {"}) {
    std::string text = "scene 1\nlet a = ";
    for (int i = 0; i < 20'000; ++i) text += bracket;
    labels(text + "|");
    EXPECT_THAT(labels(text + "\n\nlet b = 1\n|"), Contains("sphere"));
  }
}

/// Every prefix of a text with all kinds of statements, with the cursor anywhere in it.
TEST(Completion, AnswersAnywhereInAnyBeginningOfAText) {
  const std::string text =
      "scene 1\r\nimport \"l.scene\" as l /* x */\nparam n: number = 3 // é\n"
      "fn f(a: angle, b = (1, 2, 3).x) = if a > 1deg then b else not c\n"
      "def d(k) {\n  for i in [1, 2] { let q = \"}\"\n sphere s { center: l.p[i].y, } }\n}\n"
      "if true { d { k: #fff } } else if x == -2 { group { include \"𝄞\" } }\n"
      "camera { shutter: 0 .. 1ms }\rassert n < 2, \"no\"";
  for (std::size_t end = 0; end <= text.size(); ++end) {
    for (const std::size_t cursor : {end, end / 2, end > 3 ? end - 3 : 0}) {
      std::string marked = text.substr(0, end);
      marked.insert(std::min(cursor, end), "|");
      for (const auto& item : completions(MarkedScene(marked)).items) {
        EXPECT_LE(item.replaced.begin, cursor);
        EXPECT_GE(item.replaced.end, cursor);
        EXPECT_LE(item.replaced.end, end);
        EXPECT_FALSE(item.text.empty());
      }
    }
  }
}

}  // namespace
}  // namespace sdlc::test
