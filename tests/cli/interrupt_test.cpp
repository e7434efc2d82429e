#include "cli/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <filesystem>
#include <span>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "render/image/atomic_file.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using cli::handle_signals;
using cli::InterruptGuard;
using testing::ContainsRegex;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::KilledBySignal;

// Each in a separate process: handlers stay installed.
class Interrupt : public testing::Test {
 protected:
  Interrupt() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  const TemporaryFolder folder_;
};

[[noreturn]] void end(bool is_right) { std::_Exit(is_right ? 0 : 1); }

TEST_F(Interrupt, SetsTheFlagAtFirst) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    EXPECT_EXIT(
        {
          handle_signals();
          std::atomic<bool> flag{false};
          const InterruptGuard guard(flag);
          std::raise(signal);
          end(flag.load());
        },
        testing::ExitedWithCode(0), "");
  }
}

TEST_F(Interrupt, EndsTheProcessAtTheSecondSignalOfAnyKind) {
  EXPECT_EXIT(
      {
        handle_signals();
        std::atomic<bool> flag{false};
        const InterruptGuard guard(flag);
        std::raise(SIGINT);
        std::raise(SIGTERM);
        end(false);
      },
      KilledBySignal(SIGTERM), "");
}

TEST_F(Interrupt, EndsTheProcessAtOnceWithoutAGuard) {
  EXPECT_EXIT(
      {
        handle_signals();
        {
          std::atomic<bool> flag{false};
          const InterruptGuard guard(flag);
        }
        std::raise(SIGHUP);
        end(false);
      },
      KilledBySignal(SIGHUP), "");
}

TEST_F(Interrupt, SetsTheFlagsOfGuardsAround) {
  EXPECT_EXIT(
      {
        handle_signals();
        std::atomic<bool> outer{false};
        std::atomic<bool> first{false};
        std::atomic<bool> second{false};
        const InterruptGuard around(outer);
        {
          const InterruptGuard guard(first);
          std::raise(SIGINT);
        }
        const InterruptGuard guard(second);
        end(outer.load() && first.load() && second.load());
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(Interrupt, IsIgnoredWhereItWasBefore) {
  EXPECT_EXIT(
      {
        std::signal(SIGHUP, SIG_IGN);
        handle_signals();
        std::raise(SIGHUP);
        end(true);
      },
      testing::ExitedWithCode(0), "");
}

void write_interrupted(const fs::path& path) {
  handle_signals();
  // The limit sends a signal during the writing, while the temporary file exists.
  std::signal(SIGXFSZ, [](int) {
    std::raise(SIGTERM);
    std::raise(SIGTERM);
  });
  const rlimit limit{4, 4};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  std::atomic<bool> flag{false};
  const InterruptGuard guard(flag);
  const render::ParentFolders folders(path);
  const std::string bytes(8, 'x');
  render::write_file_atomically(path, std::as_bytes(std::span(bytes)));
}

TEST_F(Interrupt, TakesItsTemporaryFileAndFoldersAway) {
  EXPECT_EXIT(write_interrupted(folder_ / "new/deep/a.png"), KilledBySignal(SIGTERM), "");
  EXPECT_THAT(names_in(folder_.path()), IsEmpty());
}

/// The pid of the program. A picture goes to a pipe, whose writer waits for a reader, so the write
/// can be delayed as long as a test needs.
class InterruptedProgram : public testing::Test {
 protected:
  InterruptedProgram() {
    write_text(folder_ / "ball.scene",
               "scene 1\ncamera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }\n"
               "sphere { center: (0, 0, 0), radius: 1, material: unlit(red) }\n"
               "render { width: 32, samples: 4 }\n");
    write_text(folder_ / "film.scene",
               content_of(folder_ / "ball.scene") + "animation { frames: 1..30, fps: 24 }\n");
  }

  /// Runs the program in the background until the file `ready` exists, sends the signals, and reads
  /// the pipe `pipe`.
  ProgramResult run(const std::string& arguments, const std::string& ready,
                    const std::string& signals, const std::string& pipe) {
    return run_shell(folder_.path(),
                     "mkfifo " + pipe +
                         "\n"
                         "env --default-signal=INT \"$SDLC\" " +
                         arguments +
                         " & pid=$!\n"
                         "until [ -e " +
                         ready + " ] || ! kill -0 $pid; do sleep 0.05; done\n" + signals +
                         "\ncat " + pipe + " >got & cat=$!\nwait $pid; code=$?\n: 3<>" + pipe +
                         "  # lets cat go where the program did not\nwait $cat; exit $code");
  }

  /// Sends the signal when the program opens the pipe diff.png, then reads the pipe.
  ProgramResult compare(const std::string& pictures) {
    return run_shell(folder_.path(),
                     "mkfifo diff.png\n"
                     "env --default-signal=INT \"$SDLC\" compare " +
                         pictures +
                         " -o diff.png & pid=$!\n"
                         "( exec 3<diff.png; kill -INT $pid; cat <&3 >got ) & reader=$!\n"
                         "wait $pid; code=$?\n"
                         // Ends the reader if the program never opened the pipe.
                         "while kill -0 $reader 2>/dev/null; do : 3<>diff.png; sleep 0.05; done\n"
                         "exit $code");
  }

  const TemporaryFolder folder_;
};

TEST_F(InterruptedProgram, WritesAPictureThatIsFinished) {
  for (const std::string signal : {"INT", "TERM", "HUP"}) {
    const ProgramResult result = run("render ball.scene -o first.png -o pipe.png", "first.png",
                                     "kill -" + signal + " $pid", "pipe.png");
    EXPECT_EQ(result.exit_code, 130) << signal << "\n" << result.err;
    EXPECT_THAT(result.err, HasSubstr("interrupted; the picture was finished")) << signal;
    EXPECT_EQ(content_of(folder_ / "got"), content_of(folder_ / "first.png")) << signal;
    EXPECT_THAT(names_in(folder_.path()),
                ElementsAre("ball.scene", "film.scene", "first.png", "got", "pipe.png"));
    fs::remove(folder_ / "first.png");
    fs::remove(folder_ / "pipe.png");
  }
}

TEST_F(InterruptedProgram, WritesTheLayersOfAPictureThatIsFinished) {
  const ProgramResult result = run("render ball.scene --aov normal,depth -o first.exr -o pipe.exr",
                                   "first.exr", "kill -INT $pid", "pipe.exr");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_EQ(content_of(folder_ / "got"), content_of(folder_ / "first.exr"));
}

// The first frame waits for its pipe, while the next ones are rendered; only some may wait.
TEST_F(InterruptedProgram, EndsBetweenTwoFrames) {
  const ProgramResult result = run("render film.scene -o f####.png -o p####.png", "f0001.png",
                                   "kill -INT $pid", "p0001.png");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, ContainsRegex("interrupted; [0-9]+ of 30 frames were finished"));
  EXPECT_EQ(content_of(folder_ / "got"), content_of(folder_ / "f0001.png"));
  EXPECT_FALSE(fs::exists(folder_ / "f0020.png"));
}

TEST_F(InterruptedProgram, EndsAtOnceAtTheSecondSignal) {
  const ProgramResult result =
      run_shell(folder_.path(),
                "mkfifo pipe.png\n"
                "env --default-signal=INT \"$SDLC\" render ball.scene -o first.png -o pipe.png "
                "& pid=$!\n"
                "until [ -e first.png ] || ! kill -0 $pid; do sleep 0.05; done\n"
                "kill -INT $pid; kill -TERM $pid; wait $pid");
  EXPECT_THAT(result.exit_code, testing::AnyOf(128 + SIGTERM, 128 + SIGINT));
  EXPECT_THAT(names_in(folder_.path()),
              ElementsAre("ball.scene", "film.scene", "first.png", "pipe.png"));
}

TEST_F(InterruptedProgram, WritesAComparison) {
  ASSERT_EQ(run_shell(folder_.path(), "\"$SDLC\" render ball.scene --quiet -o a.png").exit_code, 0);
  const ProgramResult result = compare("a.png a.png");
  // The signal came either during the write, or just after.
  EXPECT_THAT(result.exit_code, testing::AnyOf(130, 0)) << result.err;
  EXPECT_THAT(content_of(folder_ / "got"), HasSubstr("PNG"));
}

TEST_F(InterruptedProgram, DoesNotWaitForAComparisonThatFails) {
  EXPECT_EQ(compare("missing.png missing.png").exit_code, 2);
  EXPECT_EQ(content_of(folder_ / "got"), "");
}

TEST_F(InterruptedProgram, WritesTheReportsOfAMeasurementThatIsFinished) {
  const ProgramResult result = run("measure ball.scene --budget 1s -o first.csv -o pipe.json",
                                   "first.csv", "kill -TERM $pid", "pipe.json");
  EXPECT_EQ(result.exit_code, 130) << result.err;
  EXPECT_THAT(result.err, HasSubstr("interrupted; the measurement was finished"));
  EXPECT_EQ(content_of(folder_ / "got").substr(0, 1), "{");
}

}  // namespace
}  // namespace sdlc::test
