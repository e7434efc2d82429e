#include "lang/resolve/scopes.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(Scopes, FindTheInnermostLocalOfAName) {
  Scopes scopes;
  EXPECT_EQ(scopes.find("a"), std::nullopt);
  EXPECT_EQ(scopes.declare("a"), 0u);
  {
    const Scopes::Block block(scopes);
    EXPECT_FALSE(scopes.is_innermost(*scopes.find("a")));
    EXPECT_EQ(scopes.declare("a"), 1u);
    EXPECT_EQ(scopes.find("a"), 1u);
    EXPECT_TRUE(scopes.is_innermost(*scopes.find("a")));
  }
  EXPECT_EQ(scopes.find("a"), 0u);
  EXPECT_EQ(scopes.size(), 1u);
  EXPECT_EQ(scopes.frame_size(), 2u);
}

// More locals than Scopes searches linearly.
TEST(Scopes, ForgetHiddenNamesOfManyInTheRightOrder) {
  Scopes scopes;
  std::vector<std::string> names;
  for (int i = 0; i < 100; ++i) names.push_back("name" + std::to_string(i));
  for (const std::string& name : names) scopes.declare(name);
  {
    const Scopes::Block outer(scopes);
    for (const std::string& name : names) scopes.declare(name);
    {
      const Scopes::Block inner(scopes);
      for (const std::string& name : names) scopes.declare(name);
      for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(scopes.find(names[i]), 200 + i);
    }
    for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(scopes.find(names[i]), 100 + i);
  }
  for (std::uint32_t i = 0; i < 100; ++i) EXPECT_EQ(scopes.find(names[i]), i);
  EXPECT_EQ(scopes.frame_size(), 300u);
}

TEST(Scopes, HaveSlotsByFrame) {
  Scopes scopes;
  scopes.declare("a");
  scopes.declare("b");
  {
    const Scopes::Frame frame(scopes);
    const Scopes::Block block(scopes);
    scopes.reserve(3);  // those of parameters
    const std::uint32_t local = scopes.declare("c");
    EXPECT_EQ(scopes[local].frame, 1u);
    EXPECT_EQ(scopes[local].slot, 3u);
    EXPECT_EQ(scopes.frame_size(), 4u);
    EXPECT_EQ(scopes[*scopes.find("b")].frame, 0u);
    EXPECT_EQ(scopes[*scopes.find("b")].slot, 1u);
  }
  EXPECT_EQ(scopes.frame_size(), 2u);
  EXPECT_EQ(scopes[scopes.declare("d")].slot, 2u);
}

}  // namespace
}  // namespace sdlc::lang
