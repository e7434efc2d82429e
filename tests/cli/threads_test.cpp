#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

using testing::HasSubstr;

constexpr const char* kScene = R"(scene 1
camera main { from: (0, 0, 5), at: (0, 0, 0), fov: 40deg }
sphere ball { center: (0, 0, 0), radius: 1, material: diffuse(color: #c04020) }
render { width: 32, samples: 16, depth: 4 }
)";

/// Behaviour under a system that limits the number of threads.
class FewThreads : public testing::Test {
 protected:
  void SetUp() override {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer has to be loaded before few_threads.so";
#endif
#ifdef __SANITIZE_THREAD__
    GTEST_SKIP() << "the thread sanitizer has a pthread_create of its own";
#endif
    write_text(folder_ / "ball.scene", kScene);
  }

  ProgramResult run(const std::string& limit, const std::string& arguments) {
    return run_shell(folder_.path(),
                     limit + " LD_PRELOAD='" SDLC_FEW_THREADS "' \"$SDLC\" " + arguments);
  }

  const TemporaryFolder folder_;
};

TEST_F(FewThreads, RenderWithThoseThatThereAre) {
  ASSERT_EQ(run("", "render ball.scene --threads 1 --quiet -o a.png").exit_code, 0);
  const std::string picture = content_of(folder_ / "a.png");
  constexpr int kOthers = 8;  // of the libraries, for progress, and to load the codec
  for (const int workers : {1, 2, 5, 7}) {
    const ProgramResult result =
        run("FEW_THREADS=" + std::to_string(kOthers - 1 + workers),
            "render ball.scene --threads 8 --aov normal -o a.png -o b.exr --stats s.json");
    EXPECT_EQ(result.exit_code, 0) << workers << "\n" << result.err;
    EXPECT_EQ(content_of(folder_ / "a.png"), picture) << workers;
    const auto stats = nlohmann::json::parse(content_of(folder_ / "s.json"));
    EXPECT_EQ(stats["threads"], workers);
    EXPECT_THAT(result.err, HasSubstr("warning: " + std::to_string(workers) +
                                      " of 8 threads could be started"));
  }
}

TEST_F(FewThreads, AreEnoughForEveryCommandWithoutOpenImageIo) {
  for (const char* arguments :
       {"inspect ball.scene", "lint ball.scene", "convert ball.scene -o - --tone sqrt",
        "fmt ball.scene", "schema", "explain E104", "render ball.scene -o b.png --quiet",
        "compare b.png b.png"}) {
    const ProgramResult result = run("FEW_THREADS=0", arguments);
    EXPECT_EQ(result.exit_code, 0) << arguments << "\n" << result.err;
  }
}

TEST_F(FewThreads, AreReportedIfTooFewForOpenImageIo) {
  ASSERT_EQ(run("", "render ball.scene --quiet -o a.jpg").exit_code, 0);
  for (const int limit : {0, 1, 3, 5}) {
    for (const char* arguments :
         {"render ball.scene --samples 1000000000 -o c.jpg", "compare a.jpg a.jpg"}) {
      const ProgramResult result = run("FEW_THREADS=" + std::to_string(limit), arguments);
      EXPECT_EQ(result.exit_code, 2) << limit << " " << arguments << "\n" << result.err;
      EXPECT_THAT(result.err, HasSubstr("ulimit -u")) << limit << " " << arguments;
    }
  }
}

}  // namespace
}  // namespace sdlc::test
