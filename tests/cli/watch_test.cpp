#include <atomic>
#include <chrono>
#include <filesystem>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/file_watch.hpp"
#include "cli/interrupt.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// The change that a watch finds, however long that takes.
fs::path wait_for_change(cli::FileWatch& watch) {
  for (;;) {
    const auto changes = watch.wait(std::chrono::milliseconds(50));
    if (!changes.empty()) return changes.front().path;
  }
}

TEST(FileWatch, NoticesFilesThatAreWrittenReplacedMadeOrRemoved) {
  const TemporaryFolder folder;
  write_text(folder / "a", "one");
  write_text(folder / "b", "one");
  fs::create_symlink(folder / "b", folder / "link");
  const auto change_after = [&](const char* watched, const auto& change) {
    cli::FileWatch watch;
    watch.add(folder / watched);
    EXPECT_THAT(watch.wait(std::chrono::milliseconds(0)), IsEmpty());
    change();
    EXPECT_EQ(wait_for_change(watch), folder / watched);
  };
  change_after("a", [&] { write_text(folder / "a", "two"); });
  change_after("a", [&] {
    write_text(folder / "new", "two");
    fs::rename(folder / "new", folder / "a");
  });
  change_after("none", [&] { write_text(folder / "none", ""); });
  change_after("later/none", [&] {
    fs::create_directory(folder / "later");
    write_text(folder / "later/none", "");
  });
  change_after("link", [&] { write_text(folder / "b", "two"); });
  change_after("a", [&] { fs::remove(folder / "a"); });
}

TEST(FileWatch, IgnoresOtherFiles) {
  const TemporaryFolder folder;
  write_text(folder / "a", "one");
  cli::FileWatch watch;
  watch.add(folder / "a");
  watch.add(folder / "a");
  EXPECT_EQ(watch.size(), 1);
  write_text(folder / "b", "one");
  for (int i = 0; i < 3; ++i) EXPECT_THAT(watch.wait(std::chrono::milliseconds(10)), IsEmpty());
}

TEST(FileWatch, ReportsAChangeOnceToEachReaderButNoSameContents) {
  const TemporaryFolder folder;
  write_text(folder / "a", "one");
  cli::FileWatch watch;
  std::error_code error;
  for (const cli::FileWatch::Reader reader : {0, 1}) {
    EXPECT_EQ(cli::WatchedFiles(watch, reader).read(folder / "a", 99, error), "one");
  }
  EXPECT_EQ(watch.size(), 1);
  write_text(folder / "a", "one");
  for (int i = 0; i < 3; ++i) EXPECT_THAT(watch.wait(std::chrono::milliseconds(10)), IsEmpty());
  write_text(folder / "a", "two");
  std::vector<cli::FileWatch::Reader> notified;
  while (notified.size() < 2) {
    for (const auto& change : watch.wait(std::chrono::milliseconds(50))) {
      notified.push_back(change.reader);
    }
  }
  EXPECT_THAT(notified, ElementsAre(0, 1));
  EXPECT_EQ(watch.size(), 0);
}

TEST(FileWatch, ReportsAFileThatWasMissingAndReturnsAsItWas) {
  const TemporaryFolder folder;
  write_text(folder / "a", "one");
  cli::FileWatch watch;
  const cli::WatchedFiles files(watch);
  std::error_code error;
  EXPECT_EQ(files.read(folder / "a", 99, error), "one");
  fs::rename(folder / "a", folder / "b");
  EXPECT_EQ(files.read(folder / "a", 99, error), std::nullopt);
  fs::rename(folder / "b", folder / "a");
  EXPECT_EQ(wait_for_change(watch), folder / "a");

  watch.add(folder / "later");  // and it cannot be read
  write_text(folder / "later", "");
  EXPECT_EQ(wait_for_change(watch), folder / "later");
}

TEST(Cancellation, EndsTheRenderUnderWayAndLaterOnes) {
  cli::Cancellation cancellation;
  std::atomic<bool> first{false}, second{false};
  {
    const cli::Cancellation::Scope scope(cancellation, first);
    EXPECT_FALSE(first);
    cancellation.request();
    EXPECT_TRUE(first);
  }
  first = false;
  cancellation.request();
  EXPECT_FALSE(first) << "it has ended";
  const cli::Cancellation::Scope scope(cancellation, second);
  EXPECT_TRUE(second);
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

/// Runs `render --watch`; "wait_for N TEXT" waits until the messages have N lines with the text.
class Watch : public testing::Test {
 protected:
  static constexpr const char* kScene =
      "scene 1\n"
      "import \"colors.scene\" as colors\n"
      "camera main { from: (0, 0, 9), at: (0, 0, 0), fov: 40deg }\n"
      "background { color: colors.sky }\n"
      "render { width: 8, height: 8, samples: 1 }\n";

  void SetUp() override {
    write_text(folder_ / "a.scene", kScene);
    write_text(folder_ / "colors.scene", "scene 1\nlet sky = rgb(1, 2, 3)\n");
  }

  ProgramResult watch(const std::string& arguments, const std::string& steps) const {
    return run_shell(folder_.path(),
                     "\"$SDLC\" render a.scene " + arguments +
                         " --watch 2>log & job=$!\n"
                         "wait_for() { until [ $(grep -c \"$2\" log) -ge $1 ]; do\n"
                         "  kill -0 $job || exit 9; sleep 0.01; done; }\n" +
                         steps + "\nkill $job; wait $job; status=$?; cat log >&2; exit $status");
  }

  TemporaryFolder folder_;
};

TEST_F(Watch, RendersAgainAfterEachChange) {
  const ProgramResult result = watch("-o a.ppm --ppm-text",
                                     "wait_for 1 '^watching'; cp a.ppm first.ppm\n"
                                     "sed -i 's/1, 2, 3/4, 5, 6/' colors.scene\n"
                                     "wait_for 2 '^a.ppm: '; cp a.ppm second.ppm\n"
                                     "echo 'spere {}' >>a.scene; wait_for 1 '2 errors'\n"
                                     "cp a.ppm third.ppm\n"
                                     "sed -i '$d' a.scene; wait_for 3 '^a.ppm: '\n"
                                     "mv colors.scene away; wait_for 1 'cannot read'\n"
                                     "mv away colors.scene; wait_for 4 '^a.ppm: '");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(content_of(folder_ / "first.ppm"), HasSubstr("1\n2\n3\n"));
  EXPECT_THAT(content_of(folder_ / "second.ppm"), HasSubstr("4\n5\n6\n"));
  EXPECT_EQ(content_of(folder_ / "third.ppm"), content_of(folder_ / "second.ppm"));
  EXPECT_THAT(result.err, HasSubstr("watching 2 files; Ctrl-C ends\n"));
  EXPECT_THAT(result.err, HasSubstr("`colors.scene` has changed\n"));
  EXPECT_THAT(result.err, HasSubstr("E102"));
  EXPECT_EQ(names_in(folder_.path()),
            (std::vector<std::string>{"a.ppm", "a.scene", "colors.scene", "first.ppm", "log",
                                      "second.ppm", "third.ppm"}));
}

TEST_F(Watch, EndsARenderThatIsOutdated) {
  std::string endless = kScene;
  write_text(folder_ / "a.scene",
             endless.replace(endless.find("samples: 1"), 10, "samples: 99999999"));
  const ProgramResult result = watch("-o a.png --width 99 --progress json",
                                     "wait_for 1 fraction\n"
                                     "sed -i 's/samples: 9*/samples: 1/' a.scene\n"
                                     "wait_for 1 '^a.png: '");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, Not(HasSubstr("partial"))) << "nothing of the old scene is written";
}

TEST_F(Watch, RendersOnlyTheScenesThatAFileBelongsTo) {
  write_text(folder_ / "b.scene",
             "scene 1\ncamera { from: (0, 0, 9), at: (0, 0, 0), fov: 1deg }\n");
  const ProgramResult result =
      watch("b.scene -o {name}.png --width 8",
            "wait_for 1 '^watching 3 files'\n"
            "touch colors.scene; sed -i 's/1, 2, 3/4, 5, 6/' colors.scene; wait_for 2 '^a.png: '\n"
            "echo '// more' >>b.scene; wait_for 2 '^b.png: '");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_EQ(count_of(result.err, "a.png: "), 2) << result.err;
  EXPECT_EQ(count_of(result.err, "b.png: "), 2) << result.err;
}

TEST_F(Watch, StartsWithASceneThatIsBrokenOrMissing) {
  fs::rename(folder_ / "a.scene", folder_ / "later");
  const ProgramResult result = watch("-o a.png",
                                     "wait_for 1 'cannot read'\n"
                                     "mv later a.scene; wait_for 1 '^a.png: '");
  EXPECT_EQ(result.exit_code, 130) << result.err;
}

TEST_F(Watch, RefusesWhatCannotBeRenderedAgain) {
  const auto error_of = [&](const std::string& arguments) {
    const ProgramResult result =
        run_shell(folder_.path(), "\"$SDLC\" render --watch " + arguments + " <a.scene");
    EXPECT_EQ(result.exit_code, 2) << arguments;
    return result.err;
  };
  EXPECT_THAT(error_of("- -o a.png"), HasSubstr("standard input does not change"));
  EXPECT_THAT(error_of("a.scene -o -"), HasSubstr("standard output holds only one picture"));
  for (const char* flag : {"--checkpoint 60s", "--resume", "--no-clobber", "--skip-existing"}) {
    EXPECT_THAT(error_of(std::string("a.scene ") + flag), HasSubstr("--watch")) << flag;
  }
}

}  // namespace
}  // namespace sdlc::test
