#include "lang/editor/code_lenses.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> lenses_in(const std::string& text) {
  MarkedScene scene("scene 1\n" + text);
  std::vector<std::string> lines;
  for (const lang::RenderLens& lens : lang::render_lenses(scene.view(), 0)) {
    lines.push_back(std::string(scene.view().file(0).text(lens.where)) + " > " + lens.camera);
  }
  return lines;
}

TEST(RenderLenses, AreAboveNamedCameras) {
  EXPECT_THAT(lenses_in("sphere {}\ncamera a {}\ncamera b { fov: \n"),
              ElementsAre("camera a > a", "camera b > b"));
}

TEST(RenderLenses, AreAboveTheFirstObjectWithoutNamedCameras) {
  EXPECT_THAT(lenses_in("let a = 1\nrender {}\nsphere {}\nsphere {}\n"), ElementsAre("sphere > "));
  EXPECT_THAT(lenses_in("camera {}\nsphere {}\n"), ElementsAre("camera > "));
  EXPECT_THAT(lenses_in("for i in range(2) { sphere {} }\n"), ElementsAre(" > "));
  EXPECT_THAT(lenses_in("def camera() {}\ncamera c {}\n"), ElementsAre("camera > "));
}

TEST(RenderLenses, AreNotInLibraries) {
  EXPECT_THAT(lenses_in("let a = 1\ndef d() { sphere {} }\nassert a > 0, \"x\"\n"), IsEmpty());
  EXPECT_THAT(lenses_in(""), IsEmpty());
}

}  // namespace
}  // namespace sdlc::test
