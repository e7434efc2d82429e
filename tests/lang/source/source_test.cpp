#include "lang/source/source.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/temporary_folder.hpp"

namespace sdlc::lang {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(DiskFileSystem, ListsTheContentsOfAFolderByName) {
  const test::TemporaryFolder folder;
  std::ofstream(folder.path() / "b.scene") << "scene 1";
  std::ofstream(folder.path() / "a.json") << "{}";
  fs::create_directory(folder.path() / "lib");
  const DiskFileSystem disk;
  EXPECT_THAT(disk.list(folder.path()),
              ElementsAre(FolderEntry{"a.json", false}, FolderEntry{"b.scene", false},
                          FolderEntry{"lib", true}));
  EXPECT_THAT(disk.list(folder.path() / "lib"), IsEmpty());
  EXPECT_THAT(disk.list(folder.path() / "missing"), IsEmpty());
  EXPECT_THAT(disk.list(folder.path() / "a.json"), IsEmpty());
}

}  // namespace
}  // namespace sdlc::lang
