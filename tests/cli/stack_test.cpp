#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// Every file within the nesting limits can be read, with any stack size of the process.
namespace sdlc::test {
namespace {

constexpr const char* kCamera = "scene 1\ncamera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

class SmallStack : public testing::TestWithParam<const char*> {
 protected:
  void write(const std::string& name, const std::string& text) { write_text(folder_ / name, text); }
  /// Runs the program with this stack size in KiB.
  ProgramResult run_on(const std::string& stack, const std::string& arguments) const {
    return run_shell(folder_.path(), "ulimit -s " + stack + " || exit 99\n\"$SDLC\" " + arguments);
  }

  TemporaryFolder folder_;
};

TEST_P(SmallStack, IsEnoughForAllThatMayBeNested) {
  const auto nested = [](const std::string& open, const std::string& close, std::size_t depth) {
    std::string text;
    for (std::size_t i = 0; i < depth; ++i) text += open;
    text += "1";
    for (std::size_t i = 0; i < depth; ++i) text += close;
    return text;
  };
  write("brackets.scene", std::string(kCamera) + "let a = " + nested("(", ")", 127) + "\n");
  write("lists.scene", std::string(kCamera) + "let a = " + nested("[", "]", 127) + "\n");
  write("conditions.scene",
        std::string(kCamera) + "let a = " + nested("if 1 == 1 then (", ") else 0", 63) + "\n");
  write("defs.scene", std::string(kCamera) +
                          "def d(n) { group { if n > 0 { d { n: n - 1 } } } }\n" +
                          "d { n: 126 }\n");
  write("calls.scene", std::string(kCamera) +
                           "fn f(n) = if n == 0 then 0 else -(-(-(1 + f(n - 1))))\n" +
                           "let a = f(126)\n");
  write("deep.json", "{\"spheres\": " + nested("[", "]", 126) + "}");
  const std::string names = " brackets.scene lists.scene conditions.scene defs.scene calls.scene";
  const ProgramResult linted = run_on(GetParam(), "lint --select E" + names);
  if (linted.exit_code == 99) GTEST_SKIP() << "the shell cannot limit the stack";
  EXPECT_EQ(linted.exit_code, 0) << linted.out << linted.err;
  EXPECT_EQ(run_on(GetParam(), "fmt --diff" + names).exit_code, 1);
  EXPECT_EQ(run_on(GetParam(), "lint deep.json").exit_code, 1);
  EXPECT_EQ(run_on(GetParam(), "inspect calls.scene defs.scene").exit_code, 2);
  EXPECT_EQ(run_on(GetParam(), "inspect defs.scene").exit_code, 0);
}

TEST_P(SmallStack, IsEnoughForAPicture) {
  write("ball.scene", std::string(kCamera) +
                          "render { width: 16, samples: 2 }\nbackground { color: white }\n"
                          "for i in range(1000) { sphere { center: (i, 0, 0), radius: 0.4, "
                          "material: diffuse(color: red) } }\n");
  const ProgramResult result = run_on(GetParam(), "render ball.scene -o ball.png --quiet");
  if (result.exit_code == 99) GTEST_SKIP() << "the shell cannot limit the stack";
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "ball.png"));
}

INSTANTIATE_TEST_SUITE_P(KiB, SmallStack, testing::Values("64", "256", "1024", "8192"));

}  // namespace
}  // namespace sdlc::test
