#include "lsp/folder_index.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "lang/source/source.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

class FolderIndexTest : public testing::Test {
 protected:
  void write(const std::string& name, const std::string& text) {
    fs::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name) << text;
  }
  void start(lsp::FolderIndex::Events events = {}, std::size_t max = lsp::FolderIndex::kMaxScenes) {
    index_.emplace(disk_, std::move(events), max);
    index_->set_folders({folder_.path()});
    index_->wait();
  }
  /// Relative to the folder.
  Names names(const std::vector<fs::path>& paths) const {
    Names all;
    for (const fs::path& path : paths) {
      all.push_back(path.lexically_relative(disk_.identity(folder_.path())).generic_string());
    }
    return all;
  }
  Names files() const { return names(index_->files()); }
  Names roots_of(const std::string& name) const { return names(index_->roots_of(folder_ / name)); }
  Names symbols() const {
    Names all;
    for (const auto& facts : index_->facts()) {
      for (const lsp::IndexedSymbol& symbol : facts->symbols) all.emplace_back(symbol.name);
    }
    return all;
  }
  void update(const std::string& name) {
    index_->update(folder_ / name);
    index_->wait();
  }

  const TemporaryFolder folder_;
  const lang::DiskFileSystem disk_;
  std::optional<lsp::FolderIndex> index_;
};

TEST_F(FolderIndexTest, FindsTheScenesThatReadAFile) {
  write("main.scene", "scene 1\nimport \"lib/colors.scene\" as c\n");
  write("other.scene", "scene 1\ninclude \"./lib/../parts/ring.scene\"\n");
  write("parts/ring.scene", "scene 1\nimport \"../lib/colors.scene\" as c\n");
  write("lib/colors.scene", "scene 1\nlet red = #f00\n");
  start();
  EXPECT_EQ(files(), (Names{"lib/colors.scene", "main.scene", "other.scene", "parts/ring.scene"}));
  EXPECT_EQ(roots_of("lib/colors.scene"), (Names{"main.scene", "other.scene", "parts/ring.scene"}));
  EXPECT_EQ(roots_of("parts/ring.scene"), (Names{"other.scene"}));
  EXPECT_TRUE(roots_of("main.scene").empty());
  EXPECT_TRUE(roots_of("missing.scene").empty());
}

TEST_F(FolderIndexTest, FollowsCyclesOnce) {
  write("a.scene", "scene 1\nimport \"b.scene\" as b\n");
  write("b.scene", "scene 1\nimport \"a.scene\" as a\n");
  write("c.scene", "scene 1\nimport \"c.scene\" as c\nimport \"a.scene\" as a\n");
  start();
  EXPECT_EQ(roots_of("a.scene"), (Names{"c.scene", "b.scene"}));
  EXPECT_TRUE(roots_of("c.scene").empty());
}

TEST_F(FolderIndexTest, ReadsBrokenTextsAndEscapes) {
  write("broken.scene",
        "scene 1\nlet a = (\nsphere {\n import \"lib\\u002escene\" as x\n// import \"no.scene\" as "
        "n\n"
        "let t = \"include\" \"no.scene\"\ninclude: \"no.scene\"\ninclude \"unclosed.scene\n");
  write("crlf.scene", "\xEF\xBB\xBFscene 1\r\ninclude\r\n  \"lib.scene\"\r\n");
  write("empty.scene", "");
  write("bytes.scene", std::string("\xFF\xFE\0import \"lib.scene\"", 22));
  start();
  EXPECT_EQ(roots_of("lib.scene"), (Names{"broken.scene", "bytes.scene", "crlf.scene"}));
  EXPECT_TRUE(roots_of("no.scene").empty());
}

TEST_F(FolderIndexTest, KnowsWhatIncludesAConfig) {
  write("main.scene", "scene 1\ninclude \"old.json\"\n");
  start();
  EXPECT_EQ(roots_of("old.json"), (Names{"main.scene"}));
  EXPECT_EQ(files(), (Names{"main.scene"}));
}

TEST_F(FolderIndexTest, KeepsTheNamesOfDeclarations) {
  write("main.scene",
        "scene 1\nlet red = #f00\nfn f(x) = x\ndef ring(n: number) {\n  sphere bead { radius: 1 "
        "}\n}\n"
        "camera \xF0\x9F\x98\x80 {}\nsphere { radius: 1 }\ncamera main {}\n");
  start();
  const auto facts = index_->facts();
  ASSERT_EQ(facts.size(), 1u);
  const auto& found = facts[0]->symbols;
  EXPECT_EQ(symbols(), (Names{"red", "f", "ring", "bead", "main"}));
  EXPECT_EQ(found[3].container, "ring");
  EXPECT_EQ(found[3].object_kind, "sphere");
  EXPECT_EQ(found[3].begin, (lang::Position{5, 10}));
  EXPECT_EQ(found[3].end, (lang::Position{5, 14}));
}

TEST_F(FolderIndexTest, SkipsHiddenAndGeneratedFoldersAndLinksToFolders) {
  write("a.scene", "scene 1\n");
  write(".hidden.scene", "scene 1\n");
  write(".git/b.scene", "scene 1\n");
  write("node_modules/c.scene", "scene 1\n");
  write("build/CMakeCache.txt", "");
  write("build/d.scene", "scene 1\n");
  write("target/CACHEDIR.TAG", "");
  write("target/debug/e.scene", "scene 1\n");
  write("folder.scene/f.scene", "scene 1\n");
  fs::create_directory_symlink(folder_.path(), folder_ / "loop");
  fs::create_symlink("nowhere.scene", folder_ / "broken.scene");
  fs::create_symlink("a.scene", folder_ / "same.scene");
  ASSERT_EQ(::mkfifo((folder_ / "pipe.scene").c_str(), 0600), 0);
  start();
  EXPECT_EQ(files(), (Names{"a.scene"}));
  // Nor are they read when they change.
  for (const char* name : {".git/b.scene", "build/d.scene", "node_modules/c.scene", "pipe.scene"}) {
    update(name);
  }
  EXPECT_EQ(files(), (Names{"a.scene"}));
}

TEST_F(FolderIndexTest, SkipsWhatItMayNotRead) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  write("a.scene", "scene 1\n");
  write("secret/b.scene", "scene 1\n");
  fs::permissions(folder_ / "secret", fs::perms::none);
  start();
  EXPECT_EQ(files(), (Names{"a.scene"}));
  fs::permissions(folder_ / "secret", fs::perms::owner_all);
}

TEST_F(FolderIndexTest, FollowsChangesOfFiles) {
  write("main.scene", "scene 1\n");
  std::atomic<int> changes = 0;
  start({.changed = [&] { ++changes; }});
  EXPECT_EQ(changes, 1);
  write("main.scene", "scene 1\nimport \"lib.scene\" as l\n");
  update("main.scene");
  EXPECT_EQ(roots_of("lib.scene"), (Names{"main.scene"}));
  EXPECT_EQ(changes, 2);
  write("main.scene", "scene 1\nimport \"lib.scene\" as l\nlet a = 1\n");
  update("main.scene");
  EXPECT_EQ(changes, 2);  // the imports are the same
  EXPECT_EQ(symbols(), (Names{"l", "a"}));
  write("new/deep/other.scene", "scene 1\nimport \"../../lib.scene\" as l\n");
  update("new/deep/other.scene");
  EXPECT_EQ(roots_of("lib.scene"), (Names{"main.scene", "new/deep/other.scene"}));
  fs::remove(folder_ / "main.scene");
  update("main.scene");
  EXPECT_EQ(roots_of("lib.scene"), (Names{"new/deep/other.scene"}));
  fs::remove_all(folder_ / "new");
  update("new");
  EXPECT_TRUE(files().empty());
}

TEST_F(FolderIndexTest, ReadsNewFolders) {
  start();
  write("new/a.scene", "scene 1\n");
  update("new");
  EXPECT_EQ(files(), (Names{"new/a.scene"}));
}

TEST_F(FolderIndexTest, PrefersOpenTexts) {
  write("main.scene", "scene 1\nimport \"old.scene\" as l\n");
  start();
  const auto text = std::make_shared<const std::string>("scene 1\nimport \"new.scene\" as l\n");
  index_->open(folder_ / "main.scene", text);
  index_->wait();
  EXPECT_EQ(roots_of("new.scene"), (Names{"main.scene"}));
  EXPECT_TRUE(roots_of("old.scene").empty());
  update("main.scene");  // saved by someone else
  EXPECT_EQ(roots_of("new.scene"), (Names{"main.scene"}));
  index_->close(folder_ / "main.scene");
  index_->wait();
  EXPECT_EQ(roots_of("old.scene"), (Names{"main.scene"}));
}

TEST_F(FolderIndexTest, ReadsOpenTextsOutsideOfTheFolders) {
  start();
  const TemporaryFolder outside;
  const fs::path path = outside / "far.scene";
  index_->open(path, std::make_shared<const std::string>("scene 1\ninclude \"x.scene\"\n"));
  index_->wait();
  EXPECT_EQ(index_->files().size(), 1u);
  EXPECT_EQ(index_->roots_of(outside / "x.scene").size(), 1u);
  index_->set_folders({folder_.path()});
  index_->wait();
  EXPECT_EQ(index_->files().size(), 1u);
  index_->close(path);
  index_->wait();
  EXPECT_TRUE(index_->files().empty());
}

TEST_F(FolderIndexTest, ForgetsTheFilesOfOtherFolders) {
  write("a/a.scene", "scene 1\n");
  write("b/b.scene", "scene 1\n");
  start();
  index_->set_folders({folder_ / "b", folder_ / "missing"});
  index_->wait();
  EXPECT_EQ(files(), (Names{"b/b.scene"}));
}

TEST_F(FolderIndexTest, StopsAtItsLimit) {
  for (int i = 0; i < 20; ++i) write("f/" + std::to_string(i) + ".scene", "scene 1\n");
  write("top.scene", "scene 1\n");
  start({}, 5);
  EXPECT_EQ(files().size(), 5u);
  EXPECT_EQ(std::ranges::count(files(), "top.scene"), 1);
}

TEST_F(FolderIndexTest, KeepsAChangedFileThatALinkLeadsTo) {
  const TemporaryFolder outside;
  const fs::path target = outside / "far.scene";
  std::ofstream(target) << "scene 1\n";
  fs::create_symlink(target, folder_ / "link.scene");
  start();
  ASSERT_EQ(index_->files(), std::vector{target});
  std::ofstream(target) << "scene 1\nlet far = 1\n";
  index_->update(target);
  index_->wait();
  EXPECT_EQ(symbols(), (Names{"far"}));
  fs::remove(target);
  index_->update(target);
  index_->wait();
  EXPECT_EQ(index_->files(), std::vector<fs::path>());
}

/// Files with something that happens before the first of them is read.
class FilesWithEvent final : public lang::FileSystem {
 public:
  std::optional<std::string> read(const fs::path& path, std::uint64_t max,
                                  std::error_code& error) const override {
    if (const auto happens = std::exchange(event, nullptr)) happens();
    return disk_.read(path, max, error);
  }
  fs::path identity(const fs::path& path) const override { return disk_.identity(path); }

  mutable std::function<void()> event;

 private:
  lang::DiskFileSystem disk_;
};

TEST_F(FolderIndexTest, KeepsAFileThatIsCreatedDuringTheWalkOfItsFolder) {
  write("first.scene", "scene 1\n");
  FilesWithEvent files;
  lsp::FolderIndex index(files, {}, lsp::FolderIndex::kMaxScenes, false);
  files.event = [&] {
    write("later.scene", "scene 1\n");
    index.update(folder_ / "later.scene");
  };
  index.set_folders({folder_.path()});
  index.run_due();
  EXPECT_EQ(names(index.files()), (Names{"first.scene", "later.scene"}));
}

/// Files that take a while to read.
class SlowFiles final : public lang::FileSystem {
 public:
  std::optional<std::string> read(const fs::path& path, std::uint64_t max,
                                  std::error_code& error) const override {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return disk_.read(path, max, error);
  }
  fs::path identity(const fs::path& path) const override { return disk_.identity(path); }

 private:
  lang::DiskFileSystem disk_;
};

TEST_F(FolderIndexTest, ReportsALongWalkAndEndsItWhenItIsDestroyed) {
  for (int i = 0; i < 100; ++i) write(std::to_string(i) + ".scene", "scene 1\n");
  const SlowFiles files;
  std::atomic<int> begun = 0, reported = 0, ended = 0;
  {
    lsp::FolderIndex index(files, {.begin = [&] { ++begun; },
                                   .report = [&](const auto&) { ++reported; },
                                   .end = [&](const auto&) { ++ended; },
                                   .changed = {}});
    index.set_folders({folder_.path()});
    while (reported < 2) std::this_thread::yield();
    EXPECT_FALSE(index.is_complete());
    EXPECT_EQ(begun, 1);
    EXPECT_EQ(ended, 0);
    EXPECT_LT(index.files().size(), 100u);
  }
  EXPECT_EQ(ended, 1);
}

TEST_F(FolderIndexTest, MayBeAskedWhileItReads) {
  for (int i = 0; i < 300; ++i) {
    write(std::to_string(i) + ".scene", "scene 1\nimport \"lib.scene\" as l\n");
  }
  index_.emplace(disk_, lsp::FolderIndex::Events{});
  index_->set_folders({folder_.path()});
  std::size_t last = 0;
  while (last < 300) {
    const std::size_t now = roots_of("lib.scene").size();
    EXPECT_GE(now, last);
    last = now;
  }
}

}  // namespace
}  // namespace sdlc::test
