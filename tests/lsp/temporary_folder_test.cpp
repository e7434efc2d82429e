#include "lsp/temporary_folder.hpp"

#include <filesystem>

#include <gtest/gtest.h>

namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

TEST(TemporaryFolder, IsRemovedAtItsEnd) {
  fs::path path;
  {
    lsp::TemporaryFolder folder;
    path = folder.path();
    EXPECT_TRUE(fs::is_directory(path));
    EXPECT_EQ(folder.path(), path);
  }
  EXPECT_FALSE(fs::exists(path));
}

TEST(TemporaryFolder, RemovesThoseThatWereAbandonedAndNoOthers) {
  lsp::TemporaryFolder used, next;
  const fs::path abandoned = fs::temp_directory_path() / "sdlc-lsp-abandoned";
  fs::create_directories(abandoned / "1");
  used.path();
  EXPECT_FALSE(fs::exists(abandoned));
  next.path();
  EXPECT_TRUE(fs::exists(used.path()));
  EXPECT_NE(used.path(), next.path());
}

}  // namespace
}  // namespace sdlc::test
