#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

// The limits on resources, with the real program.
namespace sdlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr const char* kCamera = "scene 1\ncamera { from: (0, 1, 5), at: (0, 0, 0), fov: 40deg }\n";

class LimitsOfFiles : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) { write_text(folder_ / name, text); }
  ProgramResult run(const std::string& command) const { return run_shell(folder_.path(), command); }

  TemporaryFolder folder_;
};

TEST_F(LimitsOfFiles, AnEndlessFileIsReadNoFurtherThanItMayBeLong) {
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero.scene");
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero.json");
  for (const std::string command : {"lint", "inspect", "convert -o -", "render -o a.png"}) {
    const std::string flags = " --limit file=4KiB --limit config=2KiB ";
    const ProgramResult scene = run("\"$SDLC\" " + command + flags + "zero.scene");
    EXPECT_EQ(scene.exit_code, 1) << command;
    EXPECT_THAT(scene.out + scene.err, HasSubstr("E308]: the file is longer than 4096 bytes"));
    const ProgramResult config = run("\"$SDLC\" " + command + flags + "zero.json");
    EXPECT_EQ(config.exit_code, 1) << command;
    EXPECT_THAT(config.out + config.err, HasSubstr("E308]: the file is longer than 2048 bytes"));
  }
  const ProgramResult formatted = run("\"$SDLC\" fmt --check --limit file=4KiB zero.scene");
  EXPECT_EQ(formatted.exit_code, 1);
  EXPECT_THAT(formatted.err, HasSubstr("E308]: the file is longer than 4096 bytes"));
}

TEST_F(LimitsOfFiles, AnImportedFileIsReadNoFurtherEither) {
  std::filesystem::create_directory(folder_ / "parts");
  write("parts/long.scene", "scene 1\n" + std::string(100'000, '\n'));
  write("parts/long.json", "{" + std::string(100'000, ' ') + "}");
  write("a.scene", std::string(kCamera) + "import \"parts/long.scene\" as long\n");
  write("b.scene", std::string(kCamera) + "include \"parts/long.json\"\n");
  const std::string flags = " --limit file=1000 --limit config=1000";
  for (const std::string name : {"a.scene", "b.scene"}) {
    const ProgramResult result = run("\"$SDLC\" lint " + name + flags);
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_THAT(result.out, HasSubstr("the file is longer than 1000 bytes")) << name;
  }
}

TEST_F(LimitsOfFiles, AFileOfSettingsIsReadNoFurtherEither) {
  std::filesystem::create_symlink("/dev/zero", folder_ / "zero.toml");
  write("a.scene", kCamera);
  const ProgramResult result = run("\"$SDLC\" lint a.scene --config zero.toml");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("it has more than 1048576 bytes"));
  ASSERT_EQ(::mkfifo((folder_ / ".sdlc.toml").c_str(), 0600), 0);
  const ProgramResult pipe = run("\"$SDLC\" lint a.scene");
  EXPECT_EQ(pipe.exit_code, 2);
  EXPECT_THAT(pipe.err, HasSubstr("it is not a regular file"));
}

TEST_F(LimitsOfFiles, WhatCannotBeReplacedIsRefusedBeforeItIsRead) {
  const auto pipe = folder_ / "pipe.scene";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const std::string command : {"fmt", "lint --fix", "lint --unsafe-fixes"}) {
    for (const std::string name : {"pipe.scene", "/dev/null"}) {
      // Nobody writes to the pipe: reading it would block forever.
      const ProgramResult result = run("\"$SDLC\" " + command + " " + name);
      EXPECT_EQ(result.exit_code, 2) << command;
      EXPECT_THAT(result.err, HasSubstr("it is not a regular file")) << command;
      EXPECT_THAT(result.out + result.err, Not(HasSubstr("1 file"))) << command;
    }
  }
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(LimitsOfFiles, APipeIsReadWhereNothingIsReplaced) {
  const auto pipe = folder_ / "pipe.scene";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  write("messy.scene", "scene 1\nlet   a=1\nassert a == 1, \"\"\n");
  const std::string feed = "cat messy.scene >pipe.scene & ";
  EXPECT_EQ(run(feed + "\"$SDLC\" fmt --check pipe.scene").out, "pipe.scene\n");
  EXPECT_THAT(run(feed + "\"$SDLC\" lint --fix --diff pipe.scene").err, Not(HasSubstr("error")));
  EXPECT_EQ(run(feed + "\"$SDLC\" lint pipe.scene").exit_code, 0);
  EXPECT_EQ(run("cat messy.scene | \"$SDLC\" fmt -").out,
            "scene 1\nlet a = 1\nassert a == 1, \"\"\n");
  EXPECT_EQ(run("cat messy.scene | \"$SDLC\" lint /dev/stdin").exit_code, 0);
}

TEST_F(LimitsOfFiles, LimitsTakeUnits) {
  write("a.scene", std::string(kCamera) + "let a = \"" + std::string(3000, 'x') + "\"\n");
  EXPECT_THAT(run("\"$SDLC\" lint a.scene --limit string=2KiB").out,
              HasSubstr("a string longer than 2048 bytes"));
  EXPECT_THAT(run("\"$SDLC\" lint a.scene --limit string=3KiB").out, Not(HasSubstr("string")));
  for (const std::string value : {"KiB", "2kb", "2 KiB", "20000000000GiB", "-1", ""}) {
    const ProgramResult result = run("\"$SDLC\" lint a.scene --limit 'memory=" + value + "'");
    EXPECT_EQ(result.exit_code, 2) << value;
    EXPECT_THAT(result.err, HasSubstr("memory takes a whole number")) << value;
  }
}

}  // namespace
}  // namespace sdlc::test
