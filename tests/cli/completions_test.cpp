#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A folder with a scene.
class Completions : public testing::Test {
 protected:
  void SetUp() override {
    write_text(folder_ / "a.scene",
               "scene 1\n"
               "camera main { from: (0, 0, 1), at: (0, 0, 0), fov: 40deg }\n"
               "camera side { from: (1, 0, 0), at: (0, 0, 0), fov: 40deg }\n"
               "param count = 3\n"
               "param shade = 0.5\n"
               "sphere {");
  }

  /// What the last of these words may be completed to: texts, one a line.
  std::string complete(const std::string& words) const {
    return run_shell(folder_.path(), "set -- sdlc " + words +
                                         "; \"$SDLC\" complete -- $(($# - 1)) \"$@\" | cut -f1")
        .out;
  }
  /// Runs a script in a shell in which `sdlc` is the program.
  ProgramResult run(const std::string& shell, const std::string& script) const {
    write_text(folder_ / "script", script);
    return run_shell(folder_.path(),
                     "PATH=$(dirname \"$SDLC\"):$PATH TERM=dumb " + shell + " ./script");
  }

  const TemporaryFolder folder_;
};

TEST_F(Completions, KnowCommandsFlagsAndValues) {
  EXPECT_EQ(complete("ren"), "render\n");
  EXPECT_THAT(complete("''"), HasSubstr("lint\n"));
  EXPECT_THAT(complete("''"), Not(HasSubstr("complete\n"))) << "it is hidden";
  EXPECT_EQ(complete("render --denoi"), "--denoise\n");
  EXPECT_EQ(complete("render --tone ''"), "srgb\nsqrt\nlinear\nneutral\n");
  EXPECT_EQ(complete("render --tone=s"), "--tone=srgb\n--tone=sqrt\n");
  EXPECT_EQ(complete("render --tone = s"), "srgb\nsqrt\n") << "as bash splits it";
  EXPECT_EQ(complete("render --tone ="), "srgb\nsqrt\nlinear\nneutral\n");
  EXPECT_EQ(complete("explain E104"), "E104\n");
  EXPECT_THAT(complete("lint --select W4"), StartsWith("W4"));
  EXPECT_EQ(complete("help fm"), "fmt\n");
  EXPECT_EQ(complete("farm st"), "status\n");
  EXPECT_EQ(complete("render a"), "") << "the shell knows files";
}

TEST_F(Completions, KnowTheNamesOfAScene) {
  EXPECT_EQ(complete("render a.scene --camera ''"), "main\nside\n");
  EXPECT_EQ(complete("render --set a.scene sh"), "") << "no value follows a file";
  EXPECT_EQ(complete("render a.scene --set ''"), "count=\nshade=\n");
  EXPECT_EQ(complete("render none.scene --camera ''"), "");
  EXPECT_EQ(complete("render --camera ''"), "");
}

TEST_F(Completions, WorkInBash) {
  const auto result = run("bash",
                          "source <(sdlc completions bash)\n"
                          "complete -p sdlc\n"
                          "words() { COMP_WORDS=(\"$@\") COMP_CWORD=$(($# - 1)); _sdlc; "
                          "echo \"${COMPREPLY[*]}\"; }\n"
                          "compopt() { echo \"compopt $*\"; }\n"
                          "words sdlc render a.scene --camera ''\n"
                          "words sdlc render a.scene --set c\n");
  EXPECT_EQ(result.out,
            "complete -o bashdefault -o default -F _sdlc sdlc\n"
            "main side\n"
            "compopt -o nospace\n"
            "count=\n")
      << result.err;
}

TEST_F(Completions, WorkInFish) {
  if (!has_program("fish")) GTEST_SKIP() << "fish is not installed";
  const auto result = run("fish",
                          "sdlc completions fish | source\n"
                          "complete -C 'sdlc render a.scene --camera '\n"
                          "complete -C 'sdlc explain E10'\n");
  EXPECT_THAT(result.out, HasSubstr("main")) << result.err;
  EXPECT_THAT(result.out, HasSubstr("E104\tunknown property"));
}

TEST_F(Completions, WorkInZsh) {
  if (!has_program("zsh")) GTEST_SKIP() << "zsh is not installed";
  const auto result = run("zsh -f",
                          "zmodload zsh/zpty\n"
                          "zpty z zsh -f -i\n"
                          "zpty -w z 'PS1=; autoload -Uz compinit; compinit -u -D; "
                          "source <(sdlc completions zsh)'\n"
                          "zpty -n -w z $'sdlc render a.scene --camera si\\t; echo \"<$?>\"'\n"
                          "zpty -n -w z $'\\n'\n"
                          "zpty -r -m z line '*--camera side *'\n"
                          "print -r -- $line\n");
  if (result.err.find("can't open pseudo terminal") != std::string::npos) {
    GTEST_SKIP() << "needs pseudo-terminals";
  }
  EXPECT_THAT(result.out, HasSubstr("--camera side")) << result.err;
}

TEST_F(Completions, OfOtherShellsAreRefused) {
  const auto result = run_shell(folder_.path(), "\"$SDLC\" completions tcsh");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_THAT(result.err, HasSubstr("`tcsh` is not one of bash, zsh, fish"));
}

TEST(ManualPages, AreThereForEachCommand) {
  const TemporaryFolder folder;
  const auto commands =
      run_shell(folder.path(), "set -- sdlc ''; \"$SDLC\" complete -- 1 \"$@\" | cut -f1");
  EXPECT_THAT(commands.out, HasSubstr("render\n"));
  const auto pages = run_shell(folder.path(),
                               "for c in '' $(\"$SDLC\" complete -- 1 sdlc '' | cut -f1); do "
                               "\"$SDLC\" man $c >sdlc${c:+-$c}.1 || exit 1; done; "
                               "ls *.1 | wc -l; cat sdlc-render.1");
  EXPECT_EQ(pages.exit_code, 0);
  EXPECT_THAT(pages.out, HasSubstr("\\fB\\-\\-denoise\\fR"));
  EXPECT_THAT(pages.out, HasSubstr(".TH SDLC\\-RENDER 1"));
  if (!has_program("mandoc")) GTEST_SKIP() << "mandoc is not installed";
  // They have no date, so that builds are reproducible.
  const auto lint =
      run_shell(folder.path(), "mandoc -T lint -W warning *.1 | grep -v 'missing date'");
  EXPECT_EQ(lint.out, "") << lint.out;
}

TEST(Help, IsACommandToo) {
  const TemporaryFolder folder;
  const auto help = run_shell(folder.path(), "\"$SDLC\" help render");
  EXPECT_EQ(help.exit_code, 0);
  EXPECT_EQ(help.out, run_shell(folder.path(), "\"$SDLC\" render --help").out);
  EXPECT_THAT(run_shell(folder.path(), "\"$SDLC\" help").out, HasSubstr("sdlc new ball"));
  EXPECT_EQ(run_shell(folder.path(), "\"$SDLC\" help rendr").exit_code, 2);
}

}  // namespace
}  // namespace sdlc::test
