#include "lang/source/sandbox.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/program/program.hpp"
#include "lang/report/findings.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;
using testing::Each;
using testing::StartsWith;

/// Absolute paths only. Records the paths it is asked about.
class RecordingFiles final : public FileSystem {
 public:
  explicit RecordingFiles(std::map<std::string, std::string> links) : links_(std::move(links)) {}

  std::optional<std::string> read(const fs::path& path, std::uint64_t /*most*/,
                                  std::error_code& error) const override {
    ask(path);
    error = std::make_error_code(std::errc::no_such_file_or_directory);
    return std::nullopt;
  }
  std::vector<FolderEntry> list(const fs::path& folder) const override {
    ask(folder);
    return {};
  }
  bool is_special(const fs::path& path) const override {
    ask(path);
    return false;
  }
  std::optional<fs::path> link_target(const fs::path& path) const override {
    ask(path);
    const auto found = links_.find(path.string());
    return found == links_.end() ? std::nullopt : std::optional<fs::path>(found->second);
  }
  fs::path identity(const fs::path& path) const override {
    ask(path);
    return path.lexically_normal();
  }
  const std::vector<std::string>& asked() const { return asked_; }
  void forget() { asked_.clear(); }

 private:
  void ask(const fs::path& path) const { asked_.push_back(path.string()); }

  std::map<std::string, std::string> links_;
  mutable std::vector<std::string> asked_;
};

std::string resolved_by(const Sandbox& sandbox, const fs::path& path) {
  const std::optional<fs::path> result = sandbox.resolve(path);
  return result ? result->string() : "refused";
}

/// /home/box/main.scene, with links in its folder.
class SandboxTest : public testing::Test {
 protected:
  std::string resolved(const std::string& path) const {
    return resolved_by(Sandbox(files_, "/home/box/main.scene"), path);
  }

  RecordingFiles files_{{{"/home/box/out", "/etc"},
                         {"/home/box/up", ".."},
                         {"/home/box/here", "."},
                         {"/home/box/deep", "a/b/c"},
                         {"/home/box/loop", "loop"},
                         {"/home/box/back", "../box/a"},
                         {"/home/box/aside", "../other/../box/a"},
                         {"/home/box/full", "/home/box/a"},
                         {"/home/box/trick", "here/../passwd"},
                         {"/home/box/fair", "deep/../x"},
                         {"/home/box/chain", "full/../up/secret"}}};
};

TEST_F(SandboxTest, KeepsToTheFolder) {
  EXPECT_EQ(resolved("/home/box/a.scene"), "/home/box/a.scene");
  EXPECT_EQ(resolved("/home/box/a/./b//c.png"), "/home/box/a/b/c.png");
  EXPECT_EQ(resolved("/home/box/a/../b.png"), "/home/box/b.png");
  for (const char* path : {"/home/box/../a.png", "/home/boxes/a.png", "/home/a.png", "/",
                           "/home/box/a/../../b", "relative.png", "/home/box/../../etc/passwd"}) {
    EXPECT_EQ(resolved(path), "refused") << path;
  }
}

TEST_F(SandboxTest, FollowsLinksThatStayInside) {
  EXPECT_EQ(resolved("/home/box/deep/x"), "/home/box/a/b/c/x");
  EXPECT_EQ(resolved("/home/box/here/here/x"), "/home/box/x");
  EXPECT_EQ(resolved("/home/box/back/x"), "/home/box/a/x");
  EXPECT_EQ(resolved("/home/box/full/x"), "/home/box/a/x");
  EXPECT_EQ(resolved("/home/box/fair"), "/home/box/a/b/x") << "`..` is the folder before c";
}

TEST_F(SandboxTest, RefusesLinksThatLeadOut) {
  for (const char* path : {"out", "out/passwd", "up", "up/x", "up/box/a", "trick", "chain", "loop",
                           "aside", "deep/../../../../../x", "here/up/x"}) {
    // Going up and down again by the folder's own name stays inside.
    const bool is_round_trip = std::string(path) == "up/box/a";
    EXPECT_EQ(resolved(std::string("/home/box/") + path) == "refused", !is_round_trip) << path;
  }
}

TEST_F(SandboxTest, DoesNotTakeADotDotAfterALinkForTheLinksFolder) {
  EXPECT_EQ(resolved("/home/box/here/../x"), "refused");
  EXPECT_EQ(resolved("/home/box/out/../x"), "refused");
}

TEST_F(SandboxTest, AsksForNothingOutside) {
  const Sandbox sandbox(files_, "/home/box/main.scene");
  files_.forget();  // the folder itself was named by the user
  for (const char* path : {"/etc/passwd", "/home/box/../x", "/home/box/out/passwd",
                           "/home/box/up/x", "/home/box/chain", "/home/box/trick", "x"}) {
    EXPECT_FALSE(sandbox.resolve(path)) << path;
  }
  EXPECT_THAT(files_.asked(), Each(StartsWith("/home/box/")));
}

TEST_F(SandboxTest, TakesAFolderThatIsNamedWithDotDot) {
  const Sandbox sandbox(files_, "/home/other/../box/main.scene");
  files_.forget();
  Workspace workspace(files_);
  for (const char* path : {"/home/other/../box/p.scene", "/home/box/p.scene"}) {
    EXPECT_EQ(resolved_by(sandbox, path), "/home/box/p.scene") << path;
  }
  EXPECT_EQ(resolved_by(sandbox, "/home/other/../box/deep/x"), "/home/box/a/b/c/x");
  for (const char* path :
       {"/home/other/p.scene", "/home/other/../p.scene", "/home/other/../box/../p.scene",
        "/home/other/../other/p.scene", "/home/other/../box/out/passwd"}) {
    EXPECT_FALSE(sandbox.resolve(path)) << path;
  }
  EXPECT_THAT(files_.asked(), Each(StartsWith("/home/box/")));
}

TEST_F(SandboxTest, TakesARelativeFolderThatIsNamedWithDotDot) {
  for (const char* scene : {"../box/main.scene", "../other/../box/main.scene"}) {
    const Sandbox sandbox(files_, scene);
    EXPECT_TRUE(sandbox.resolve("../box/p.scene")) << scene;
    EXPECT_TRUE(sandbox.resolve(fs::absolute("../box/p.scene").lexically_normal())) << scene;
    EXPECT_FALSE(sandbox.resolve("../p.scene")) << scene;
    EXPECT_FALSE(sandbox.resolve("../other/p.scene")) << scene;
    EXPECT_FALSE(sandbox.resolve("p.scene")) << scene;
  }
}

TEST(SandboxOnDisk, DoesNotTakeADotDotAfterALinkForTheLinksFolder) {
  const test::TemporaryFolder folder;
  const fs::path top = fs::canonical(folder.path());
  for (const char* name : {"x/box", "y/box", "y/sub"}) fs::create_directories(top / name);
  fs::create_directory_symlink("../y/sub", top / "x/link");
  const DiskFileSystem files;
  const Sandbox sandbox(files, top / "x/link/../box/main.scene");  // in y/box
  const std::string file = (top / "y/box/p.scene").string();
  EXPECT_EQ(resolved_by(sandbox, top / "x/link/../box/p.scene"), file);
  EXPECT_EQ(resolved_by(sandbox, file), file);
  EXPECT_FALSE(sandbox.resolve(top / "x/box/p.scene")) << "another folder";
}

TEST_F(SandboxTest, HoldsForImportsAndIncludes) {
  const Document root("/home/box/main.scene",
                      "scene 1\n"
                      "import \"../a.scene\" as a\n"
                      "import \"/etc/passwd\" as b\n"
                      "import \"out/passwd\" as c\n"
                      "import \"up/d.scene\" as d\n"
                      "import \"e.scene\" as e\n");
  files_.forget();
  Workspace workspace(files_);
  DiagnosticSink sink;
  const ProgramOptions options{
      .workspace = &workspace, .limits = {}, .is_sandboxed = true, .sets = {}};
  const Program program(root, options, sink);
  std::vector<std::string> codes;
  for (const Diagnostic* diagnostic : select_findings(sink).shown)
    codes.emplace_back(diagnostic->info->code);
  EXPECT_THAT(codes, testing::ElementsAre("E312", "E312", "E312", "E312", "E309"));
  EXPECT_THAT(files_.asked(), Each(StartsWith("/home/box")));
}

}  // namespace
}  // namespace sdlc::lang
