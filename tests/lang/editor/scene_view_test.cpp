#include "lang/editor/scene_view.hpp"

#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

TEST(SceneView, FindsTheFilesOfTheScene) {
  MarkedScene scene({{"root.scene", "scene 1\nimport \"lib.scene\" as lib\nlet a = lib.unit\n"},
                     {"lib.scene", "scene 1\nlet un|it = 1\n"}});
  EXPECT_EQ(scene.view().file_count(), 2u);
  EXPECT_EQ(scene.view().file(scene.file()).name(), "lib.scene");
  EXPECT_EQ(
      scene.view().index().references(scene.view().index().at(scene.file(), scene.offset())).size(),
      2u);
  EXPECT_FALSE(scene.view().find("other.scene"));
}

TEST(SceneView, AcceptsBrokenTexts) {
  MarkedScene scene("scene 1\nlet a = 1\nlet b = \nsphere { radius: |");
  EXPECT_EQ(scene.view().table(scene.file()).symbols().size(), 1u);
}

}  // namespace
}  // namespace sdlc::test
