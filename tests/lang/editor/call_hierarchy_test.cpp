#include "lang/editor/call_hierarchy.hpp"

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

const std::map<std::string, std::string> kTexts{{"lib.scene", R"(scene 1
fn half(of) = of / 2
fn quarter(of) = half(half(of))
def pair(gap = half(1)) { sphere { radius: quarter(gap) } }
let quiet = half(3)
)"},
                                                {"one.scene", R"(scene 1
import "lib.scene" as lib
def flake(n) { lib.pair {} if n > 0 { flake { n: n - 1 } } }
flake { n: 2 }
lib.pair { gap: lib.half(2) }
)"},
                                                {"two.scene", R"(scene 1
import "lib.scene" as l
fn own(x) = l.half(sin(x))
)"}};

std::vector<std::string> described(const std::vector<CallGroup>& groups) {
  std::vector<std::string> all;
  for (const CallGroup& group : groups) {
    all.push_back(fmt::format("{}{} {} x{}", group.item.is_file ? "file " : "", group.item.name,
                              group.item.path.generic_string(), group.places.size()));
  }
  return all;
}

std::vector<std::string> incoming(const std::string& file, const std::string& cursor) {
  const SharedScenes scenes(kTexts, {"one.scene", "two.scene"});
  KnownScenes all = scenes.scenes();
  return described(incoming_calls(all, scenes.symbol(file, cursor)));
}

std::vector<std::string> outgoing(const std::string& file, const std::string& cursor) {
  const SharedScenes scenes(kTexts, {"one.scene"});
  const SceneView& view = scenes.view(0);
  const auto item =
      call_item_at(view, *view.find(file), offset_in(scenes.texts().at(file), cursor));
  return item ? described(outgoing_calls(view, *item)) : std::vector<std::string>{"no item"};
}

TEST(CallHierarchy, ListsCallersInAllScenes) {
  EXPECT_THAT(incoming("lib.scene", "half"),
              ElementsAre("file lib.scene lib.scene x1", "quarter lib.scene x2",
                          "pair lib.scene x1", "file one.scene one.scene x1", "own two.scene x1"));
  EXPECT_THAT(incoming("lib.scene", "pair"),
              ElementsAre("file one.scene one.scene x1", "flake one.scene x1"));
  EXPECT_THAT(incoming("one.scene", "flake"),
              ElementsAre("file one.scene one.scene x1", "flake one.scene x1"));
}

TEST(CallHierarchy, ListsCallees) {
  EXPECT_THAT(outgoing("lib.scene", "quarter"), ElementsAre("half lib.scene x2"));
  EXPECT_THAT(outgoing("one.scene", "pair"),
              ElementsAre("half lib.scene x1", "quarter lib.scene x1"));
  EXPECT_THAT(outgoing("one.scene", "flake {#2"),
              ElementsAre("pair lib.scene x1", "flake one.scene x1"));
  EXPECT_THAT(outgoing("lib.scene", "half"), IsEmpty());
  EXPECT_THAT(outgoing("lib.scene", "quiet"), ElementsAre("no item"));
}

TEST(CallHierarchy, ListsWhatTheTopLevelCalls) {
  const SharedScenes scenes(kTexts, {"one.scene"});
  const CallItem file{
      .is_file = true, .name = "one.scene", .path = "one.scene", .whole = {}, .where = {}};
  EXPECT_THAT(described(outgoing_calls(scenes.view(0), file)),
              ElementsAre("half lib.scene x1", "pair lib.scene x1", "flake one.scene x1"));
}

}  // namespace
}  // namespace sdlc::test
