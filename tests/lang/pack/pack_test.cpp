#include "lang/pack/pack.hpp"

#include <string>
#include <system_error>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const Pack kPack{.scene = "rooms/ball.scene",
                 .files = {{"rooms/ball.scene", "scene 1\n"},
                           {"rooms/door.scene", "scene 1\n// a door\n"},
                           {"library/a/b.csv", "x,y\n1,2\n"},
                           {"library/c.scene", "scene 1\n"}}};

std::string refusal(const std::vector<ZipEntry>& entries) {
  try {
    read_pack(write_zip(entries), {});
    return "";
  } catch (const ZipError& error) {
    return error.what();
  }
}

TEST(Pack, IsReadAsItWasWritten) {
  const Pack read = read_pack(write_pack(kPack), {});
  EXPECT_EQ(read.scene, kPack.scene);
  EXPECT_EQ(read.files, kPack.files);
}

TEST(Pack, BeginsWithAnIndexThatNamesTheScene) {
  const auto entries = read_zip(write_pack(kPack), {});
  ASSERT_EQ(entries.size(), 5u);
  EXPECT_EQ(entries[0].name, "sdlc-pack.json");
  EXPECT_EQ(entries[0].content, "{\"format\":1,\"scene\":\"rooms/ball.scene\"}\n");
}

TEST(Pack, IsRefusedWithoutARightIndex) {
  const auto with_index = [](const std::string& text) {
    return refusal({{.name = "sdlc-pack.json", .content = text}, {.name = "a", .content = ""}});
  };
  EXPECT_EQ(with_index(R"({"format": 1, "scene": "a"})"), "");
  EXPECT_THAT(refusal({{.name = "a", .content = ""}}), HasSubstr("has no sdlc-pack.json"));
  EXPECT_THAT(with_index(""), HasSubstr("not that of a pack"));
  EXPECT_THAT(with_index("[1]"), HasSubstr("not that of a pack"));
  EXPECT_THAT(with_index(std::string(60'000, '[')), HasSubstr("not that of a pack"));
  EXPECT_THAT(with_index(std::string(70'000, ' ')), HasSubstr("too large"));
  EXPECT_THAT(with_index(R"({"format": 2, "scene": "a"})"), HasSubstr("another version"));
  EXPECT_THAT(with_index(R"({"format": 1})"), HasSubstr("names no scene"));
  EXPECT_THAT(with_index(R"({"format": 1, "scene": "b"})"), HasSubstr("`b` is missing"));
  EXPECT_THAT(with_index(R"({"format": 1, "scene": "../b"})"), HasSubstr("`../b` is missing"));
  EXPECT_THAT(with_index(R"({"format": 1, "scene": "sdlc-pack.json"})"), HasSubstr("is missing"));
}

TEST(Pack, HasNoFileWithTheNameOfItsIndex) {
  Pack pack = kPack;
  pack.files["sdlc-pack.json"] = "{}";
  EXPECT_THROW(write_pack(pack), ZipError);
}

class PackFilesOf : public testing::TestWithParam<std::string> {
 protected:
  std::string read(const std::string& path) const {
    std::error_code error;
    const auto text = PackFiles(GetParam(), kPack).read(path, 1000, error);
    EXPECT_NE(text.has_value(), static_cast<bool>(error));
    return text.value_or(error.message());
  }
};

TEST_P(PackFilesOf, AreInTheFolderThatThePackPretendsToBe) {
  const std::string root = GetParam();
  EXPECT_EQ(PackFiles(root, kPack).scene(), root + "/rooms/ball.scene");
  EXPECT_EQ(read(root + "/rooms/door.scene"), "scene 1\n// a door\n");
  EXPECT_EQ(read(root + "/rooms/../library/a/b.csv"), "x,y\n1,2\n");
}

TEST_P(PackFilesOf, AreNotThoseOfTheDisk) {
  const std::string root = GetParam();
  for (const std::string& path :
       {std::string("/etc/passwd"), root + "/../../../../../../etc/passwd", root + "/..", root,
        root + "/rooms", root + "/sdlc-pack.json", std::string("rooms/door.scene"),
        root + "x/rooms/door.scene", std::string("-"), std::string()}) {
    EXPECT_EQ(read(path), "it is not in the pack") << path;
  }
}

INSTANTIATE_TEST_SUITE_P(Roots, PackFilesOf,
                         testing::Values("a.sdlc.zip", "./a.sdlc.zip", "../b/a.sdlc.zip",
                                         "/home/user/a.sdlc.zip", "b/../a.sdlc.zip"));

TEST(PackFiles, ReadAtMostOneByteMoreThanIsWanted) {
  std::error_code error;
  EXPECT_EQ(PackFiles("a", kPack).read("a/rooms/ball.scene", 3, error), "scen");
}

TEST(PackFiles, ListFolders) {
  const PackFiles files("a.zip", kPack);
  EXPECT_THAT(files.list("a.zip"),
              ElementsAre(FolderEntry{"library", true}, FolderEntry{"rooms", true}));
  EXPECT_THAT(files.list("a.zip/library/"),
              ElementsAre(FolderEntry{"a", true}, FolderEntry{"c.scene", false}));
  EXPECT_THAT(files.list("a.zip/.."), IsEmpty());
  EXPECT_THAT(files.list("/"), IsEmpty());
}

}  // namespace
}  // namespace sdlc::lang
