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

}  // namespace
}  // namespace sdlc::lang
