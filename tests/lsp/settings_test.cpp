#include "lsp/settings.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/lsp/test_client.hpp"

namespace sdlc::test {
namespace {

std::vector<std::string> mistakes_of(const Json& json) {
  std::vector<std::string> mistakes;
  lsp::Settings::of(json, mistakes);
  return mistakes;
}

TEST(Settings, AreReadFromAnObject) {
  std::vector<std::string> mistakes;
  const Json json{{"threads", 3},
                  {"sandbox", true},
                  {"inlayHints", true},
                  {"trace", {{"server", "verbose"}}},
                  {"path", "/usr/bin/sdlc"}};
  const lsp::Settings settings = lsp::Settings::of(json, mistakes);
  EXPECT_EQ(settings.threads, 3);
  EXPECT_TRUE(settings.is_sandboxed);
  EXPECT_TRUE(settings.inlay_hints);
  EXPECT_EQ(settings.trace, lsp::Trace::Verbose);
  EXPECT_TRUE(mistakes.empty());
}

TEST(Settings, MayBeMissing) {
  EXPECT_TRUE(mistakes_of(nullptr).empty());
  EXPECT_TRUE(mistakes_of({{"threads", nullptr}}).empty());
}

TEST(Settings, AreReportedIfTheyAreWrong) {
  EXPECT_EQ(mistakes_of({{"threads", "4"}}),
            std::vector<std::string>{
                "sdlc: the setting `threads` must be an integer from 0 to 10000, not \"4\""});
  EXPECT_EQ(mistakes_of({{"threads", -1}}).size(), 1U);
  EXPECT_EQ(mistakes_of({{"threads", 1.5}}).size(), 1U);
  EXPECT_EQ(mistakes_of({{"sandbox", 1}}).size(), 1U);
  EXPECT_EQ(mistakes_of({{"trace", {{"server", "loud"}}}}).size(), 1U);
  EXPECT_EQ(mistakes_of({{"trace", "off"}}).size(), 1U);
  EXPECT_EQ(mistakes_of(Json::array()).size(), 1U);
}

TEST(Settings, ThatAreUnknownAreReportedWithTheNameThatWasMeant) {
  EXPECT_EQ(mistakes_of({{"inlayHint", true}}),
            std::vector<std::string>{
                "sdlc: there is no setting `inlayHint` (did you mean `inlayHints`?)"});
}

TEST(Settings, ThatAreWrongAreShownOnce) {
  TestClient client(Json::object(), {{"threads", "4"}});
  const auto told = [&] {
    return client.wait_for_notification("window/showMessage").at("message").get<std::string>();
  };
  EXPECT_NE(told().find("`threads`"), std::string::npos);
  client.notify("workspace/didChangeConfiguration", {{"settings", {{"sdlc", {{"threads", "4"}}}}}});
  client.notify("workspace/didChangeConfiguration", {{"settings", {{"sdlc", {{"threads", "5"}}}}}});
  EXPECT_NE(told().find("\"5\""), std::string::npos);
}

}  // namespace
}  // namespace sdlc::test
