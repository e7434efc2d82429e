#include <filesystem>
#include <fstream>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;

ProgramResult sdlc(const TemporaryFolder& folder, const std::string& arguments) {
  return run_shell(folder.path(), "\"$SDLC\" " + arguments);
}

TEST(NewCommand, WritesASceneWithoutFindingsThatRenders) {
  const TemporaryFolder folder;
  const auto made = sdlc(folder, "new ball");
  EXPECT_EQ(made.exit_code, 0);
  EXPECT_EQ(made.out, "ball.scene\n");
  EXPECT_THAT(made.err, HasSubstr("sdlc render ball.scene"));
  EXPECT_THAT(content_of(folder / "ball.scene"), Not(HasSubstr("@")));
  EXPECT_EQ(sdlc(folder, "lint ball.scene --max-warnings 0").exit_code, 0);
  EXPECT_EQ(sdlc(folder, "fmt --check ball.scene").exit_code, 0);
  EXPECT_EQ(sdlc(folder, "render ball.scene --width 16 --samples 1").exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "ball.png"));
}

TEST(NewCommand, TakesAnyNameButReplacesNothing) {
  const TemporaryFolder folder;
  EXPECT_EQ(sdlc(folder, "new 'sub/a \"b\".scene' --quiet").exit_code, 0);
  EXPECT_THAT(content_of(folder / "sub/a \"b\".scene"), HasSubstr("output: \"a__b_.png\""));
  const auto again = sdlc(folder, "new 'sub/a \"b\"'");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_THAT(again.err, HasSubstr("exists already"));
  EXPECT_THAT(sdlc(folder, "new sub/").err, HasSubstr("names a folder"));
  EXPECT_THAT(sdlc(folder, "new 'sub/a \"b\".scene/c'").err, HasSubstr("cannot make the folder"));
}

}  // namespace
}  // namespace sdlc::test
