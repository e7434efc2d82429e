#include "lang/editor/navigation.hpp"

#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"
#include "tests/lang/editor/shared_scenes.hpp"

namespace sdlc::test {
namespace {

using namespace lang;
using testing::ElementsAre;
using testing::IsEmpty;

std::string describe(MarkedScene& scene, const std::optional<JumpTarget>& target) {
  if (!target) return "nothing";
  const std::string path = target->path.generic_string();
  const auto file = scene.view().find(target->path);
  const std::string_view origin = scene.view().file(scene.file()).text(target->origin);
  if (!file || target->whole.size() == 0) return fmt::format("{} -> {}", origin, path);
  const SourceFile& text = scene.view().file(*file);
  return fmt::format("{} -> {} {} in {}", origin, path, text.text(target->where),
                     text.text(target->whole));
}

std::string definition_of(std::map<std::string, std::string> texts) {
  MarkedScene scene(std::move(texts));
  return describe(scene, definition(scene.view(), scene.file(), scene.offset()));
}

std::string definition_of(std::string_view text) {
  return definition_of({{"root.scene", std::string(text)}});
}

const char* const kLibrary =
    "scene 1\nlet tint = red\nfn half(of) = of / 2\n"
    "def pair(gap: number) { sphere { radius: gap } }\n";

TEST(Definition, IsTheDeclarationOfAName) {
  EXPECT_EQ(definition_of("scene 1\nlet a = 1\nlet b = |a\n"), "a -> root.scene a in let a = 1");
  EXPECT_EQ(definition_of("scene 1\nlet a = 1\nlet b = a|\n"), "a -> root.scene a in let a = 1");
  EXPECT_EQ(definition_of("scene 1\nlet |a = 1\n"), "a -> root.scene a in let a = 1");
  EXPECT_EQ(definition_of("scene 1\nfn f(n) = n\nlet b = f(|n: 2)\n"), "n -> root.scene n in n");
  EXPECT_EQ(definition_of("scene 1\ndef d(n) {}\nd { |n: 2 }\n"), "n -> root.scene n in n");
  EXPECT_EQ(definition_of("scene 1\ndef d(n) {}\n|d { n: 2 }\n"),
            "d -> root.scene d in def d(n) {}");
  EXPECT_EQ(definition_of("scene 1\nrender { camera: |a }\ncamera a {}\n"),
            "a -> root.scene a in camera a {}");
  EXPECT_EQ(definition_of("scene 1\ncamera a { focus: |b }\ngroup { sphere b {} }\n"),
            "b -> root.scene b in sphere b {}");
  EXPECT_EQ(definition_of("scene 1\ncamera a { focus: |b }\nsphere b {}\nlet b = 1\n"),
            "b -> root.scene b in let b = 1");
}

TEST(Definition, IsInTheImportedFile) {
  const auto in_library = [](std::string_view root) {
    return definition_of({{"root.scene", std::string(root)}, {"lib/lib.scene", kLibrary}});
  };
  EXPECT_EQ(in_library("scene 1\nimport \"lib/lib.scene\" as m\nlet a = m.|tint\n"),
            "tint -> lib/lib.scene tint in let tint = red");
  EXPECT_EQ(in_library("scene 1\nimport \"lib/lib.scene\" as m\nm.|pair { gap: 1 }\n"),
            "pair -> lib/lib.scene pair in def pair(gap: number) { sphere { radius: gap } }");
  EXPECT_EQ(in_library("scene 1\nimport \"lib/lib.scene\" as m\nm.pair { |gap: 1 }\n"),
            "gap -> lib/lib.scene gap in gap: number");
  EXPECT_EQ(in_library("scene 1\nimport \"lib/lib.scene\" as m\nlet a = m.half(|of: 1)\n"),
            "of -> lib/lib.scene of in of");
}

TEST(Definition, OfAnImportIsItsFile) {
  const auto in_library = [](std::string_view root) {
    return definition_of({{"root.scene", std::string(root)}, {"lib.scene", kLibrary}});
  };
  EXPECT_EQ(in_library("scene 1\nimport \"lib.scene\" as |m\n"), "m -> lib.scene");
  EXPECT_EQ(in_library("scene 1\nimport \"lib.scene\" as m\nlet a = |m.tint\n"), "m -> lib.scene");
  EXPECT_EQ(in_library("scene 1\nimport \"li|b.scene\" as m\n"), "\"lib.scene\" -> lib.scene");
  EXPECT_EQ(in_library("scene 1\nimport \"lib.scene\"| as m\n"), "\"lib.scene\" -> lib.scene");
  EXPECT_EQ(in_library("scene 1\ngroup { include \"|no.json\" }\n"), "\"no.json\" -> no.json");
  EXPECT_EQ(in_library("scene 1\nimport \"missing.scene\" as |m\n"), "m -> missing.scene");
  EXPECT_EQ(in_library("scene 1\nimport \"|\" as m\n"), "nothing");
  MarkedScene scene({{"root.scene", "scene 1\nimport \"lib.scene\" as m\nlet a = |m.tint\n"},
                     {"lib.scene", kLibrary}});
  EXPECT_EQ(describe(scene, declaration(scene.view(), scene.file(), scene.offset())),
            "m -> root.scene m in import \"lib.scene\" as m");
}

TEST(Definition, IsMissingForOtherText) {
  EXPECT_EQ(definition_of("scene 1\nlet a = |pi\n"), "nothing");
  EXPECT_EQ(definition_of("scene 1\n|sphere { radius: 1 }\n"), "nothing");
  EXPECT_EQ(definition_of("scene 1\nlet a = |unknown\n"), "nothing");
  EXPECT_EQ(definition_of("scene 1\n// |a\nlet a = 1\n"), "nothing");
  EXPECT_EQ(definition_of("scene 1\nlet a = (1, 2, 3)\nlet b = a.|x\n"), "nothing");
  EXPECT_EQ(definition_of("|"), "nothing");
  EXPECT_EQ(definition_of("scene 1\nlet a = \"|text\"\n"), "nothing");
  MarkedScene scene("scene 1\nlet a = 1\n");
  EXPECT_FALSE(definition(scene.view(), 0, 4'000'000'000));
}

TEST(Definition, WorksInHalfAStatement) {
  EXPECT_EQ(definition_of("scene 1\nlet a = 1\nsphere { radius: |a"),
            "a -> root.scene a in let a = 1");
  EXPECT_EQ(definition_of("scene 1\nlet a = 1\nlet b = (|a + \nlet c = 2\n"),
            "a -> root.scene a in let a = 1");
  EXPECT_EQ(definition_of("scene 1\nimport \"|lib.scene"), "nothing");
}

TEST(References, AreThoseOfAllScenes) {
  const SharedScenes scenes(
      {{"one.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.tint\n"},
       {"two.scene",
        "scene 1\nimport \"mid.scene\" as m\nimport \"lib.scene\" as l\nlet b = l.tint\n"
        "l.pair { gap: l.half(of: 2) }\n"},
       {"mid.scene", "scene 1\nimport \"lib.scene\" as lib\nlet c = lib.tint\n"},
       {"lib.scene", kLibrary}},
      {"one.scene", "two.scene"});
  EXPECT_THAT(scenes.references("one.scene", "tint"),
              ElementsAre("lib.scene 2:5", "mid.scene 3:13", "one.scene 3:13", "two.scene 4:11"));
  EXPECT_THAT(scenes.references("one.scene", "tint", false),
              ElementsAre("mid.scene 3:13", "one.scene 3:13", "two.scene 4:11"));
  EXPECT_THAT(scenes.references("lib.scene", "gap"),
              ElementsAre("lib.scene 4:10", "lib.scene 4:42", "two.scene 5:10"));
  EXPECT_FALSE(scenes.symbol("lib.scene", "gap").is_local_to_file);
  EXPECT_THAT(scenes.references("two.scene", "l."),
              ElementsAre("two.scene 3:23", "two.scene 4:9", "two.scene 5:1", "two.scene 5:15"));
  EXPECT_TRUE(scenes.symbol("two.scene", "l.").is_local_to_file);
}

TEST(References, OfALanguageNameAreItsUses) {
  const SharedScenes scenes({{"one.scene", "scene 1\nsphere { radius: pi }\nlet a = pi\n"}},
                            {"one.scene"});
  EXPECT_THAT(scenes.references("one.scene", "pi"), ElementsAre("one.scene 2:18", "one.scene 3:9"));
  EXPECT_THAT(scenes.references("one.scene", "radius"), ElementsAre("one.scene 2:10"));
}

std::vector<std::string> highlights_of(std::string_view text) {
  MarkedScene scene(text);
  std::vector<std::string> found;
  for (const Highlight& highlight : highlights(scene.view(), scene.file(), scene.offset())) {
    found.push_back(fmt::format("{}{}", highlight.where.begin, highlight.is_write ? "w" : "r"));
  }
  return found;
}

TEST(Highlights, DistinguishWritesFromReads) {
  EXPECT_THAT(highlights_of("scene 1\nlet |a = 1\nlet b = a + a\n"),
              ElementsAre("12w", "26r", "30r"));
  EXPECT_THAT(highlights_of("scene 1\nfn f(n: number) = n\nlet b = f(|n : f(2))\n"),
              ElementsAre("13w", "26r", "38w"));
  EXPECT_THAT(highlights_of("scene 1\nlet a = |pi * pi\n"), ElementsAre("16r", "21r"));
  EXPECT_THAT(highlights_of("scene 1\nlet a = |no + no\n"), IsEmpty());
  EXPECT_THAT(highlights_of("|scene 1\n"), IsEmpty());
}

}  // namespace
}  // namespace sdlc::test
