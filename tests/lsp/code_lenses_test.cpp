#include <string>

#include <gtest/gtest.h>

#include "tests/lsp/ranges.hpp"
#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

Json lenses_of(const std::string& name, const std::string& text, std::string& uri) {
  TestClient client;
  client.open(name, text);
  uri = client.uri(name);
  return client.result("textDocument/codeLens", {{"textDocument", {{"uri", uri}}}});
}

TEST(CodeLensRequest, RendersWithTheCamera) {
  std::string uri;
  const Json lenses = lenses_of("a.scene", "scene 1\nsphere {}\ncamera main {}\n", uri);
  EXPECT_EQ(lenses,
            Json::array({{{"range", range_in_line(2, 0, 11)},
                          {"command",
                           {{"title", "Render"},
                            {"command", "sdlc.render"},
                            {"arguments", Json::array({{{"uri", uri}, {"camera", "main"}}})}}}}}));
}

TEST(CodeLensRequest, RendersTheOnlyCameraWithoutItsName) {
  std::string uri;
  const Json lenses = lenses_of("a.scene", "scene 1\nsphere {}\ncamera {}\n", uri);
  ASSERT_EQ(lenses.size(), 1u);
  EXPECT_EQ(lenses[0].at("command").at("arguments"), Json::array({{{"uri", uri}}}));
}

TEST(CodeLensRequest, HasNothingForConfigs) {
  std::string uri;
  EXPECT_EQ(lenses_of("c.json", "{}", uri), Json::array());
}

}  // namespace
}  // namespace sdlc::test
