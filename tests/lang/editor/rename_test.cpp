#include "lang/editor/rename.hpp"

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"
#include "tests/lang/editor/shared_scenes.hpp"

// A rename keeps the meaning of every scene, or is refused with a reason and a place.
namespace sdlc::test {
namespace {

using namespace lang;
using testing::HasSubstr;

using Texts = std::map<std::string, std::string>;

std::string refusal_of_preparing(std::string_view text) {
  MarkedScene scene(text);
  return prepare_rename(scene.view(), scene.file(), scene.offset()).refusal;
}

/// The changed texts; `refusal` at its conflict if the rename is refused.
Texts renamed(const SharedScenes& scenes, const std::string& file, const std::string& cursor,
              std::string_view new_name, const RenameOptions& options = {}) {
  KnownScenes all = scenes.scenes();
  const RenamePlan plan = plan_rename(all, scenes.symbol(file, cursor), new_name, options);
  if (!plan.refusal.empty()) {
    return {{plan.conflict ? scenes.describe(*plan.conflict) : "refused", plan.refusal}};
  }
  Texts texts;
  for (auto place = plan.places.rbegin(); place != plan.places.rend(); ++place) {
    const std::string name = place->path.generic_string();
    const auto [text, is_new] = texts.try_emplace(name, scenes.texts().at(name));
    text->second.replace(place->where.begin, place->where.size(), new_name);
  }
  return texts;
}

/// The text of a scene alone after the rename, or the refusal.
std::string renamed(const std::string& text, const std::string& cursor, std::string_view new_name) {
  const SharedScenes scenes({{"a.scene", text}}, {"a.scene"});
  return renamed(scenes, "a.scene", cursor, new_name).begin()->second;
}

TEST(PrepareRename, NamesWhatItWouldChange) {
  MarkedScene scene("scene 1\nlet size = 1\nlet b = si|ze\n");
  const RenameTarget target = prepare_rename(scene.view(), scene.file(), scene.offset());
  EXPECT_EQ(target.refusal, "");
  EXPECT_EQ(target.where, (Span{29, 33}));
}

TEST(PrepareRename, RefusesWithAReason) {
  EXPECT_EQ(refusal_of_preparing("scene 1\n|sphere { radius: 1 }\n"),
            "`sphere` is a name of the language and cannot be renamed.");
  EXPECT_EQ(refusal_of_preparing("scene 1\nlet a = |tau\n"), "`tau` is not declared.");
  EXPECT_EQ(refusal_of_preparing("scene 1\nlet a = 1| + 2\n"), "There is no name here.");
  EXPECT_EQ(refusal_of_preparing("scene 1\n// |a\nlet a = 1\n"), "There is no name here.");
  EXPECT_EQ(refusal_of_preparing("|"), "There is no name here.");
}

const Texts kLibraryAndUsers{
    {"lib.scene",
     "scene 1\n/// The tint.\nlet tint = red\nfn half(of) = of / 2\n"
     "def pair(gap) { sphere { radius: gap, material: diffuse(color: tint) } }\n"},
    {"one.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.tint\n"},
    {"two.scene",
     "scene 1\nimport \"lib.scene\" as l\nlet tint = l.tint\n"
     "l.pair { gap: l.half(of: 2) }\n"}};

TEST(RenamePlan, CoversAllScenes) {
  const SharedScenes scenes(kLibraryAndUsers, {"one.scene", "two.scene"});
  const Texts tint = renamed(scenes, "lib.scene", "tint =", "shade");
  EXPECT_EQ(tint.size(), 3u);
  EXPECT_EQ(tint.at("one.scene"), "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.shade\n");
  EXPECT_THAT(tint.at("two.scene"), HasSubstr("let tint = l.shade\n"));
  EXPECT_THAT(tint.at("lib.scene"), HasSubstr("/// The tint.\nlet shade = red"));
  EXPECT_EQ(renamed(scenes, "one.scene", "tint", "shade"), tint);
  const Texts gap = renamed(scenes, "two.scene", "gap", "width");
  EXPECT_EQ(gap.size(), 2u);
  EXPECT_THAT(gap.at("two.scene"), HasSubstr("l.pair { width: l.half(of: 2) }"));
}

TEST(RenamePlan, ChangesTheAliasOfAnImport) {
  const SharedScenes scenes(kLibraryAndUsers, {"two.scene"});
  const Texts texts = renamed(scenes, "two.scene", "l.half", "shapes");
  EXPECT_EQ(texts.size(), 1u);
  EXPECT_EQ(texts.at("two.scene"),
            "scene 1\nimport \"lib.scene\" as shapes\nlet tint = shapes.tint\n"
            "shapes.pair { gap: shapes.half(of: 2) }\n");
}

TEST(RenamePlan, ChangesTheNamesOfLoops) {
  EXPECT_EQ(renamed("scene 1\nlet a = [x + i for i, x in [1] if x > 0]\nlet x = 1\n", "x + i", "y"),
            "scene 1\nlet a = [y + i for i, y in [1] if y > 0]\nlet x = 1\n");
  EXPECT_EQ(renamed("scene 1\nfor (a, b) in [[1, 2]] { assert a < b, \"\" }\n", "b)", "c"),
            "scene 1\nfor (a, c) in [[1, 2]] { assert a < c, \"\" }\n");
}

TEST(RenamePlan, ChangesALabelThatNothingUses) {
  EXPECT_EQ(renamed("scene 1\nsphere ball { radius: 1 }\n", "ball", "globe"),
            "scene 1\nsphere globe { radius: 1 }\n");
}

TEST(RenamePlan, KeepsTheNameOfTheRest) {
  EXPECT_EQ(renamed("scene 1\n/// a\nlet a = 1 // a\nlet b = \"a\"\nsphere a { radius: a }\n",
                    "a = 1", "size"),
            "scene 1\n/// a\nlet size = 1 // a\nlet b = \"a\"\nsphere a { radius: size }\n");
  EXPECT_EQ(renamed("scene 1\r\nlet Ä = 1\r\nlet a = 1\r\n", "a = 1", "b"),
            "scene 1\r\nlet Ä = 1\r\nlet b = 1\r\n");
}

TEST(RenamePlan, NamesWhatItClashesWith) {
  const std::string text =
      "scene 1\nlet a = 1\nlet b = a\nfn f(x) = x + pi\ndef d(p) {}\nlet c = tau\n";
  EXPECT_EQ(renamed(text, "a = 1", "b"), "`b` is already the name of a value at a.scene:3:5.");
  EXPECT_EQ(renamed(text, "x)", "pi"),
            "The built-in `pi` at a.scene:4:15 would then be this parameter.");
  EXPECT_EQ(renamed(text, "a = 1", "tau"),
            "The unknown name `tau` at a.scene:6:9 would then be this value.");
  EXPECT_EQ(renamed(text, "p)", "scale"), "`scale` is a property of every instance.");
  EXPECT_EQ(renamed(text, "a = 1", "let"), "`let` is a word of the language and cannot be a name.");
  EXPECT_EQ(renamed(text, "a = 1", "2a"),
            "`2a` is not a name: a name has letters, digits and `_`, and does not begin with a "
            "digit.");
  EXPECT_EQ(renamed(text, "a = 1", ""),
            "`` is not a name: a name has letters, digits and `_`, and does not begin with a "
            "digit.");
}

TEST(RenamePlan, ClashesWithANameOfAnotherScene) {
  const SharedScenes scenes(
      {{"lib.scene", "scene 1\nlet tint = red\ndef pair(gap) {}\n"},
       {"one.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.tint\n"},
       {"two.scene", "scene 1\nimport \"lib.scene\" as l\nlet b = l.shade\nl.pair { width: 2 }\n"}},
      {"one.scene", "two.scene"});
  EXPECT_EQ(renamed(scenes, "one.scene", "tint", "shade"),
            (Texts{{"two.scene 3:11",
                    "The unknown name `shade` at two.scene:3:11 would then be this value."}}));
  EXPECT_EQ(renamed(scenes, "lib.scene", "gap", "width"),
            (Texts{{"two.scene 4:10",
                    "The unknown name `width` at two.scene:4:10 would then be this parameter."}}));
}

TEST(RenamePlan, IgnoresUnknownMembersOfOtherFiles) {
  const SharedScenes scenes({{"lib.scene", "scene 1\nlet tint = red\n"},
                             {"other.scene", "scene 1\n"},
                             {"one.scene",
                              "scene 1\nimport \"lib.scene\" as lib\nimport \"other.scene\" as o\n"
                              "let a = lib.tint\nlet b = o.shade\n"}},
                            {"one.scene"});
  EXPECT_EQ(renamed(scenes, "one.scene", "tint", "shade").size(), 2u);
}

TEST(RenamePlan, FollowsCyclesOfImports) {
  const SharedScenes scenes(
      {{"a.scene", "scene 1\nimport \"b.scene\" as b\nlet x = 1\nlet z = b.y\n"},
       {"b.scene", "scene 1\nimport \"a.scene\" as a\nlet y = a.x\n"}},
      {"a.scene", "b.scene"});
  const Texts x = renamed(scenes, "a.scene", "x =", "w");
  ASSERT_EQ(x.size(), 2u);
  EXPECT_THAT(x.at("b.scene"), HasSubstr("a.w"));
  EXPECT_EQ(renamed(scenes, "b.scene", "y =", "w").size(), 2u);
}

TEST(RenamePlan, DoesNotMakeAWordOfAName) {
  EXPECT_EQ(renamed("scene 1\nlet open = 0s .. 1s\ncamera a { shutter: open }\n", "open", "none"),
            "The meaning of the scene would change at a.scene:3:21.");
}

TEST(RenamePlan, IsPossibleInABrokenFileWhereItIsCertain) {
  EXPECT_EQ(renamed("scene 1\nlet a = 1\nlet b = a +\nlet c = a\nsphere { radius: a", "a = 1", "x"),
            "scene 1\nlet x = 1\nlet b = x +\nlet c = x\nsphere { radius: x");
  EXPECT_EQ(renamed("scene 1\nlet a = 1\nlet b = % ) a\n", "a = 1", "size"),
            "The file has syntax errors, and the meaning of `a` at a.scene:3:13 is not certain.");
}

TEST(RenamePlan, IsRefusedOutsideTheFolders) {
  const SharedScenes scenes({{"work/a.scene",
                              "scene 1\nimport \"../lib.scene\" as lib\n"
                              "let a = lib.tint\nlet b = a\n"},
                             {"lib.scene", "scene 1\nlet tint = red\n"}},
                            {"work/a.scene"});
  EXPECT_EQ(renamed(scenes, "work/a.scene", "tint", "shade", {.folders = {"work/"}}),
            (Texts{{"refused", "The name is used in `lib.scene`, which is outside the folder."}}));
  EXPECT_EQ(renamed(scenes, "work/a.scene", "tint", "shade", {.folders = {"other", ""}}).size(),
            2u);
  EXPECT_EQ(renamed(scenes, "work/a.scene", "a =", "shade", {.folders = {"work"}}).size(), 1u);
}

TEST(RenamePlan, IsRefusedAfterAChange) {
  SharedScenes scenes({{"a.scene", "scene 1\nlet a = 1\n"}}, {"a.scene"});
  scenes.workspace().open("a.scene", "scene 1\n\nlet a = 1\n");
  EXPECT_EQ(renamed(scenes, "a.scene", "a =", "b"),
            (Texts{{"refused", "`a.scene` has just been changed: try again."}}));
}

TEST(RenamePlan, ToTheSameNameChangesNothing) {
  EXPECT_EQ(renamed("scene 1\nlet a = 1\nlet b = a\n", "a =", "a"),
            "scene 1\nlet a = 1\nlet b = a\n");
}

}  // namespace
}  // namespace sdlc::test
