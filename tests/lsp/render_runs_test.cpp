#include "lsp/render_runs.hpp"

#include <chrono>
#include <condition_variable>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "lsp/uri.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using lsp::Json;

/// Renders by a shell script instead of `sdlc`, and the messages that a client receives. The script
/// finds the picture in "$picture".
class RenderRunsTest : public testing::Test {
 protected:
  struct Sent {
    std::string method;
    Json params;
    std::function<void(const Json*)> on_result;
  };

  void start_with(const std::string& script) {
    const fs::path program = folder_ / "sdlc";
    std::ofstream(program) << "#!/bin/sh\nfor a; do case \"$a\" in --output=*) "
                              "picture=\"${a#--output=}\";; esac; done\n"
                           << script;
    fs::permissions(program, fs::perms::owner_all);
    runs_.emplace(
        program.string(), [this](std::string_view method, Json params) { add(method, params, {}); },
        [this](std::string_view method, Json params, std::function<void(const Json*)> on_result) {
          add(method, params, std::move(on_result));
        });
  }

  void add(std::string_view method, const Json& params,
           std::function<void(const Json*)> on_result) {
    const std::scoped_lock lock(mutex_);
    sent_.push_back({std::string(method), params, std::move(on_result)});
    arrived_.notify_all();
  }

  /// The next message; fails the test if none comes.
  Sent next() {
    std::unique_lock lock(mutex_);
    const bool is_there =
        arrived_.wait_for(lock, std::chrono::seconds(60), [&] { return taken_ < sent_.size(); });
    if (!is_there) throw std::runtime_error("no message");
    return sent_[taken_++];
  }
  bool is_silent_for(std::chrono::milliseconds time) {
    std::unique_lock lock(mutex_);
    return !arrived_.wait_for(lock, time, [&] { return taken_ < sent_.size(); });
  }

  /// Starts a render whose progress the client accepts, up to its beginning; the token.
  std::string begin(const lsp::RenderOrder& order) {
    runs_->start(order, kAll);
    const Sent create = next();
    EXPECT_EQ(create.method, "window/workDoneProgress/create");
    create.on_result(&kNoValue);
    const Json begin = next().params;
    EXPECT_EQ(begin["value"]["kind"], "begin");
    EXPECT_EQ(begin["token"], create.params["token"]);
    return begin["token"];
  }

  static constexpr lsp::RenderRuns::Abilities kAll{.has_progress = true, .shows_documents = true};
  static constexpr lsp::RenderRuns::Abilities kNone{};
  static inline const Json kNoValue = nullptr;  ///< the result of a request that has none

  const TemporaryFolder folder_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Sent> sent_;
  std::size_t taken_ = 0;
  std::optional<lsp::RenderRuns> runs_;
};

TEST_F(RenderRunsTest, ShowProgressAndThePicture) {
  start_with(
      "read go <\"$(dirname \"$0\")/go\"\n"
      "echo '{\"fraction\": 0.25, \"eta_seconds\": 7.6}' >&2\n"
      "echo done >\"$picture\"\n");
  ASSERT_EQ(::mkfifo((folder_ / "go").c_str(), 0600), 0);
  const std::string token = begin({.scene = folder_ / "ball.scene"});
  std::ofstream(folder_ / "go") << "go\n";
  const Json report = next().params;
  EXPECT_EQ(report["value"]["kind"], "report");
  EXPECT_EQ(report["value"]["percentage"], 25);
  EXPECT_EQ(report["value"]["message"], "8 s left");
  EXPECT_EQ(report["token"], token);
  EXPECT_EQ(next().params["value"]["kind"], "end");
  const Sent show = next();
  EXPECT_EQ(show.method, "window/showDocument");
  const fs::path picture = lsp::path_of_uri(show.params["uri"].get<std::string>());
  EXPECT_EQ(picture.filename(), "ball.png");
  EXPECT_EQ(content_of(picture), "done\n");
  const Json shown{{"success", true}};
  show.on_result(&shown);
  EXPECT_TRUE(is_silent_for(std::chrono::milliseconds(50)));
  runs_.reset();
  EXPECT_FALSE(fs::exists(picture));
  EXPECT_FALSE(fs::exists(picture.parent_path().parent_path()));
}

TEST_F(RenderRunsTest, NameThePictureForAClientThatCannotShowIt) {
  start_with("echo done >\"$picture\"\n");
  runs_->start({.scene = folder_ / "ball.scene"}, kNone);
  const Sent message = next();
  EXPECT_EQ(message.method, "window/showMessage");
  EXPECT_EQ(message.params["type"], 3);
  EXPECT_NE(message.params["message"].get<std::string>().find("ball.png"), std::string::npos);
}

TEST_F(RenderRunsTest, NameThePictureIfShowingItFails) {
  start_with("echo done >\"$picture\"\n");
  runs_->start({.scene = folder_ / "ball.scene"}, {.shows_documents = true});
  const Json failed{{"success", false}};
  next().on_result(&failed);
  EXPECT_EQ(next().method, "window/showMessage");
}

TEST_F(RenderRunsTest, ReportTheFirstError) {
  start_with(
      "echo 'ball.scene:1:1: warning[W402]: small' >&2\n"
      "echo 'ball.scene:2:3: error[E104]: unknown property' >&2\nexit 1\n");
  runs_->start({.scene = folder_ / "ball.scene", .camera = "main"}, kNone);
  const Json params = next().params;
  EXPECT_EQ(params["type"], 1);
  EXPECT_EQ(params["message"],
            "Rendering ball.scene, camera main failed: ball.scene:2:3: error[E104]: unknown "
            "property");
}

TEST_F(RenderRunsTest, ReportAProgramThatCannotBeStarted) {
  start_with("");
  fs::remove(folder_ / "sdlc");
  runs_->start({.scene = folder_ / "ball.scene"}, kNone);
  EXPECT_NE(next().params["message"].get<std::string>().find("cannot be started"),
            std::string::npos);
}

TEST_F(RenderRunsTest, ReportAProgramThatIsKilled) {
  start_with("kill -9 $$\n");
  runs_->start({.scene = folder_ / "ball.scene"}, kNone);
  EXPECT_EQ(next().params["message"], "Rendering ball.scene failed: it was ended by signal 9");
}

TEST_F(RenderRunsTest, PassTheOrderToTheProgram) {
  start_with("echo \"error: $* $(cat)\" >&2\nexit 1\n");
  runs_->start({.scene = "/tmp/a b.scene",
                .text = std::make_shared<const std::string>("scene 1 of the editor"),
                .camera = "top",
                .frame = 7,
                .threads = 3,
                .is_sandboxed = true},
               kNone);
  const std::string message = next().params["message"];
  for (const char* part :
       {"render - --stdin-filename=/tmp/a b.scene --output=/", "/a b.png --progress=json",
        "--camera=top", "--frames=7", "--threads=3", "--sandbox scene 1 of the editor"}) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }
}

TEST_F(RenderRunsTest, ReadTheFileOfASavedText) {
  start_with("echo \"error: $* [$(cat)]\" >&2\nexit 1\n");
  runs_->start({.scene = "/tmp/a.scene"}, kNone);
  const std::string message = next().params["message"];
  EXPECT_NE(message.find("render /tmp/a.scene --output="), std::string::npos) << message;
  EXPECT_NE(message.find("[]"), std::string::npos) << message;
}

/// Whether the process with the number in the file exists; waits for the file.
bool runs_process(const fs::path& file) {
  pid_t process = 0;
  while (!(std::ifstream(file) >> process)) std::this_thread::yield();
  return ::kill(process, 0) == 0;
}

TEST_F(RenderRunsTest, AreKilledWhenTheyAreCancelled) {
  start_with("echo $$ >\"$(dirname \"$0\")/process\"\nexec sleep 1000\n");
  const std::string token = begin({.scene = folder_ / "ball.scene"});
  EXPECT_TRUE(runs_process(folder_ / "process"));
  runs_->cancel("another");
  runs_->cancel(17);
  EXPECT_TRUE(is_silent_for(std::chrono::milliseconds(50)));
  runs_->cancel(token);
  const Json end = next().params;
  EXPECT_EQ(end["value"]["kind"], "end");
  EXPECT_EQ(end["value"]["message"], "cancelled");
  runs_.reset();  // it has been waited for
  EXPECT_FALSE(runs_process(folder_ / "process"));
  EXPECT_TRUE(is_silent_for(std::chrono::milliseconds(0)));
}

TEST_F(RenderRunsTest, AreKilledAtTheEnd) {
  start_with("echo $$ >\"$(dirname \"$0\")/process\"\nexec sleep 1000\n");
  runs_->start({.scene = folder_ / "ball.scene"}, kNone);
  EXPECT_TRUE(runs_process(folder_ / "process"));
  runs_.reset();
  EXPECT_FALSE(runs_process(folder_ / "process"));
}

TEST_F(RenderRunsTest, ReplaceTheRenderOfTheSameScene) {
  start_with("case \"$*\" in *slow*) exec sleep 1000;; esac\necho done >\"$picture\"\n");
  const std::string first = begin({.scene = folder_ / "ball.scene", .camera = "slow"});
  const std::string other = begin({.scene = folder_ / "other.scene", .camera = "slow"});
  runs_->start({.scene = folder_ / "ball.scene"}, {.shows_documents = true});
  const Json end = next().params;
  EXPECT_EQ(end["token"], first);
  EXPECT_EQ(end["value"]["message"], "replaced");
  EXPECT_EQ(next().method, "window/showDocument");
  runs_->cancel(other);
  EXPECT_EQ(next().params["token"], other);
}

TEST_F(RenderRunsTest, SurviveLateAnswersOfTheClient) {
  start_with("echo done >\"$picture\"\n");
  runs_->start({.scene = folder_ / "ball.scene"}, kAll);
  const Sent create = next(), show = next();
  EXPECT_EQ(show.method, "window/showDocument");
  create.on_result(&kNoValue);  // nothing runs any more
  EXPECT_TRUE(is_silent_for(std::chrono::milliseconds(50)));
  runs_.reset();
  create.on_result(&kNoValue);
  show.on_result(nullptr);
}

TEST_F(RenderRunsTest, ShowNoProgressThatTheClientRefuses) {
  start_with(
      "read go <\"$(dirname \"$0\")/go\"\necho '{\"fraction\": 0.25}' >&2\necho done "
      ">\"$picture\"\n");
  ASSERT_EQ(::mkfifo((folder_ / "go").c_str(), 0600), 0);
  runs_->start({.scene = folder_ / "ball.scene"}, kAll);
  next().on_result(nullptr);
  std::ofstream(folder_ / "go") << "go\n";
  EXPECT_EQ(next().method, "window/showDocument");
}

TEST_F(RenderRunsTest, SurviveMuchAndStrangeOutput) {
  start_with(
      "printf '{\\n{\"fraction\": \"x\"}\\n{\"fraction\": 7}\\n[]\\n' >&2\n"
      "head -c 5000000 /dev/zero >&2\nhead -c 5000000 /dev/zero\necho >&2\n"
      "yes 'a line' | head -n 10000 >&2\nprintf 'error: the last one' >&2\nexit 2\n");
  begin({.scene = folder_ / "ball.scene"});
  Sent sent = next();
  while (sent.method == "$/progress") sent = next();
  EXPECT_EQ(sent.method, "window/showMessage");
}

}  // namespace
}  // namespace sdlc::test
