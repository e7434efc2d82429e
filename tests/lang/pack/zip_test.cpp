#include "lang/pack/zip.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "lang/source/limits.hpp"

namespace sdlc::lang {
namespace {

using testing::HasSubstr;

const std::string kLong = [] {
  std::string text;
  for (int i = 0; i < 1000; ++i) text += fmt::format("{},{}\n", i, i * i);
  return text;
}();

/// One file that is stored, and one that is deflated.
const std::vector<ZipEntry> kEntries{{.name = "a.scene", .content = "scene 1\n"},
                                     {.name = "data/b.csv", .content = kLong}};

/// An archive whose bytes a test changes. Offsets are those of APPNOTE 4.3.7, 4.3.12 and 4.3.16.
struct Archive {
  std::string bytes = write_zip(kEntries);

  void put(std::size_t at, std::uint64_t number, int size) {
    for (int i = 0; i < size; ++i) bytes[at + i] = static_cast<char>(number >> 8 * i & 0xFF);
  }
  std::size_t number(std::size_t at, int size) const {
    std::size_t number = 0;
    for (int i = 0; i < size; ++i)
      number |= std::size_t{static_cast<unsigned char>(bytes[at + i])} << 8 * i;
    return number;
  }
  std::size_t end() const { return bytes.size() - 22; }
  /// The first entry in the directory; the second follows its 46 bytes and 7 of the name.
  std::size_t listed(int i = 0) const { return number(end() + 16, 4) + (i == 0 ? 0 : 46 + 7); }
  std::size_t local(int i = 0) const { return number(listed(i) + 42, 4); }
  /// Changes a number in both headers of an entry. `at`: in the local one.
  void put_in_both(int i, std::size_t at, std::uint64_t number, int size) {
    const std::size_t local_at = local(i) + at;
    put(listed(i) + at + 2, number, size);
    put(local_at, number, size);
  }
  /// Renames the first file, to a name of 7 bytes.
  void rename(const std::string& name) {
    bytes.replace(listed() + 46, 7, name);
    bytes.replace(local() + 30, 7, name);
  }

  /// Why it is refused; empty if it is not.
  std::string refusal(const Limits& limits = {}) const {
    try {
      read_zip(bytes, limits);
      return "";
    } catch (const ZipError& error) {
      return error.what();
    }
  }
};

constexpr std::size_t kFlags = 6, kMethod = 8, kChecksum = 14, kPacked = 18, kSize = 22;

TEST(Zip, ReadsWhatItWrites) {
  EXPECT_EQ(read_zip(write_zip(kEntries), {}), kEntries);
  EXPECT_EQ(read_zip(write_zip({}), {}), std::vector<ZipEntry>());
  EXPECT_LT(write_zip(kEntries).size(), kLong.size()) << "it is compressed";
}

TEST(Zip, KeepsEveryByteOfAFile) {
  std::string all;
  for (int i = 0; i < 256; ++i) all += static_cast<char>(i);
  const std::vector<ZipEntry> entries{{.name = "empty", .content = ""},
                                      {.name = "all", .content = all},
                                      {.name = "größe.scene", .content = kLong}};
  EXPECT_EQ(read_zip(write_zip(entries), {}), entries);
}

TEST(Zip, StoresWhatAReaderWouldTakeForABomb) {
  const std::vector<ZipEntry> zeros{{.name = "zeros", .content = std::string(1 << 20, '0')}};
  EXPECT_EQ(read_zip(write_zip(zeros), {}), zeros);
}

struct Hostile {
  std::string name;
  std::function<void(Archive&)> change;
  std::string refusal;
};
void PrintTo(const Hostile& hostile, std::ostream* out) { *out << hostile.name; }

class HostileZip : public testing::TestWithParam<Hostile> {};

TEST_P(HostileZip, IsRefused) {
  Archive archive;
  ASSERT_EQ(archive.refusal(), "");
  GetParam().change(archive);
  EXPECT_THAT(archive.refusal(), HasSubstr(GetParam().refusal));
  EXPECT_NE(archive.refusal(), "");
}

/// The first file renamed.
Hostile named(const std::string& test, const std::string& name, const std::string& refusal) {
  return {test, [name](Archive& a) { a.rename(name); }, refusal};
}

INSTANTIATE_TEST_SUITE_P(
    Names, HostileZip,
    testing::Values(named("Parent", "../a.sc", "not a path inside the pack"),
                    named("ParentInside", "a/../bc", "not a path inside the pack"),
                    named("ParentAtEnd", "abcd/..", "not a path inside the pack"),
                    named("Absolute", "/etc/pa", "not a path inside the pack"),
                    named("Dot", "./abcde", "not a path inside the pack"),
                    named("TwoSlashes", "abc//de", "not a path inside the pack"),
                    named("Folder", "abcdef/", "a folder"),
                    named("Backslash", "..\\..\\a", "a backslash"),
                    named("Drive", "C:abcde", "a drive"),
                    named("Nul", std::string("a\0bcdef", 7), "control characters"),
                    named("Escape", "a\x1b[2Jbc", "control characters"),
                    named("Latin1",
                          "gr\xf6\xdf"
                          "abc",
                          "not UTF-8"),
                    Hostile{"Empty",
                            [](Archive& a) {
                              a.bytes = write_zip({{.name = "a", .content = ""}});
                              a.put(26, 0, 2);
                              a.put(a.listed() + 28, 0, 2);
                            },
                            "not a path inside the pack"},
                    Hostile{"TooLong",
                            [](Archive& a) {
                              const std::string name(1001, 'x');
                              const std::size_t listed = a.listed();
                              a.bytes.replace(listed + 46, 7, name);
                              a.put(listed + 28, name.size(), 2);
                              a.put(a.end() + 12, a.end() - listed, 4);
                            },
                            "more than 1000 bytes"},
                    Hostile{"Twice",
                            [](Archive& a) {
                              a.bytes = write_zip({{.name = "a.scene", .content = "1"},
                                                   {.name = "b.scene", .content = "2"}});
                              a.rename("b.scene");
                            },
                            "there twice"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Kinds, HostileZip,
    testing::Values(
        Hostile{"SymbolicLink",
                [](Archive& a) { a.put(a.listed() + 38, std::uint64_t{0120777} << 16, 4); },
                "a symbolic link"},
        Hostile{"Device",
                [](Archive& a) { a.put(a.listed() + 38, std::uint64_t{0020666} << 16, 4); },
                "not a regular file"},
        Hostile{"UnixFolder",
                [](Archive& a) { a.put(a.listed() + 38, std::uint64_t{0040755} << 16, 4); },
                "a folder"},
        Hostile{"DosFolder", [](Archive& a) { a.put(a.listed() + 38, 0x10, 4); }, "a folder"},
        Hostile{"Encrypted", [](Archive& a) { a.put_in_both(0, kFlags, 0x801, 2); }, "encrypted"},
        Hostile{"StronglyEncrypted", [](Archive& a) { a.put_in_both(0, kFlags, 0x840, 2); },
                "encrypted"},
        Hostile{"Streamed", [](Archive& a) { a.put_in_both(1, kFlags, 0x808, 2); },
                "size follows its data"},
        Hostile{"Patch", [](Archive& a) { a.put_in_both(0, kFlags, 0x820, 2); }, "flags"},
        Hostile{"Bzip2", [](Archive& a) { a.put_in_both(1, kMethod, 12, 2); }, "method 12"},
        Hostile{"NewVersion", [](Archive& a) { a.put(a.listed() + 6, 45, 2); }, "version 4.5"},
        Hostile{"Zip64File", [](Archive& a) { a.put_in_both(0, kSize, 0xFFFFFFFF, 4); }, "ZIP64"},
        Hostile{"Zip64End", [](Archive& a) { a.put(a.end() + 16, 0xFFFFFFFF, 4); }, "ZIP64"},
        Hostile{"Zip64Locator",
                [](Archive& a) {
                  std::string locator(20, '\0');
                  locator.replace(0, 4, "PK\x06\x07");
                  a.bytes.insert(a.end(), locator);
                },
                "ZIP64"},
        Hostile{"SecondDisk", [](Archive& a) { a.put(a.end() + 4, 1, 2); }, "part of several"},
        Hostile{"FileOnSecondDisk", [](Archive& a) { a.put(a.listed() + 34, 1, 2); },
                "part of several"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Places, HostileZip,
    testing::Values(
        // Two entries of the directory that share one file, as in the bombs of Fifield (2019).
        Hostile{"SameFile",
                [](Archive& a) {
                  a.bytes = write_zip(
                      {{.name = "a.scene", .content = "1"}, {.name = "b.scene", .content = "1"}});
                  a.put(a.listed(1) + 42, 0, 4);
                },
                "does not follow the entry before it"},
        Hostile{"Overlap", [](Archive& a) { a.put(a.listed(1) + 42, a.local(1) - 1, 4); },
                "does not follow the entry before it"},
        Hostile{"BeyondTheFile", [](Archive& a) { a.put(a.listed(0) + 42, 0x7FFFFFF0, 4); },
                "does not follow the entry before it"},
        Hostile{"DataBeyondTheFile", [](Archive& a) { a.put_in_both(1, kPacked, 0x7FFFFFF0, 4); },
                "cut off"},
        Hostile{"DataInTheDirectory",
                [](Archive& a) { a.put_in_both(1, kPacked, a.number(a.listed(1) + 20, 4) + 9, 4); },
                "overlaps the directory"},
        Hostile{"HiddenBytes",
                [](Archive& a) {
                  const std::size_t directory = a.listed();
                  a.bytes.insert(directory, "hidden");
                  a.put(a.end() + 16, directory + 6, 4);
                },
                "belong to no entry"},
        Hostile{"BytesInFront",
                [](Archive& a) {
                  const std::size_t directory = a.listed();
                  a.bytes.insert(0, "#!/bin/sh\n");
                  a.put(a.end() + 16, directory + 10, 4);
                },
                "disagree"},
        Hostile{"Comment", [](Archive& a) { a.bytes += "PK"; }, "bytes follow its end"},
        Hostile{"OtherName", [](Archive& a) { a.bytes.replace(30, 7, "b.scene"); }, "disagree"},
        Hostile{"OtherSize", [](Archive& a) { a.put(kSize, 9, 4); }, "disagree"},
        Hostile{"OtherMethod", [](Archive& a) { a.put(kMethod, 8, 2); }, "disagree"},
        Hostile{"MoreFiles",
                [](Archive& a) {
                  a.put(a.end() + 8, 3, 2);
                  a.put(a.end() + 10, 3, 2);
                },
                "directory is damaged"},
        Hostile{"FewerFiles",
                [](Archive& a) {
                  a.put(a.end() + 8, 1, 2);
                  a.put(a.end() + 10, 1, 2);
                },
                "another size"},
        Hostile{"DirectoryBehindItsEnd", [](Archive& a) { a.put(a.end() + 16, a.end() + 1, 4); },
                "not before its end"}),
    [](const auto& test) { return test.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Contents, HostileZip,
    testing::Values(
        Hostile{"StoredBit", [](Archive& a) { a.bytes[a.local(0) + 37] ^= 1; }, "damaged"},
        Hostile{"DeflatedBit", [](Archive& a) { a.bytes[a.local(1) + 30 + 10 + 700] ^= 1; },
                "damaged"},
        Hostile{"Checksum", [](Archive& a) { a.put_in_both(1, kChecksum, 1, 4); }, "damaged"},
        Hostile{"MoreThanDeclared",
                [](Archive& a) { a.put_in_both(1, kSize, kLong.size() - 1, 4); }, "damaged"},
        Hostile{"LessThanDeclared",
                [](Archive& a) { a.put_in_both(1, kSize, kLong.size() + 1, 4); }, "damaged"},
        Hostile{"StoredSize", [](Archive& a) { a.put_in_both(0, kSize, 7, 4); }, "damaged"},
        Hostile{
            "Ratio",
            [](Archive& a) { a.put_in_both(1, kSize, a.number(a.listed(1) + 20, 4) * 250 + 1, 4); },
            "less than 1/250"}),
    [](const auto& test) { return test.param.name; });

TEST(Zip, LimitsTheSizeOfAFile) {
  Limits limits;
  limits.file = limits.config = limits.data = kLong.size();
  EXPECT_EQ(Archive().refusal(limits), "");
  limits.file = limits.config = limits.data = kLong.size() - 1;
  EXPECT_THAT(Archive().refusal(limits), HasSubstr("`--limit data=N` allows more"));
}

TEST(Zip, LimitsTheSizeOfAllFiles) {
  Limits limits;
  limits.memory = kLong.size() + 8;
  EXPECT_EQ(Archive().refusal(limits), "");
  --limits.memory;
  EXPECT_THAT(Archive().refusal(limits), HasSubstr("`--limit memory=N` allows more"));
}

TEST(Zip, LimitsTheNumberOfFiles) {
  std::vector<ZipEntry> entries;
  for (std::size_t i = 0; i < pack_limits::kFiles; ++i) {
    entries.push_back({.name = fmt::format("{}", i), .content = ""});
  }
  Archive archive{.bytes = write_zip(entries)};
  EXPECT_EQ(archive.refusal(), "");
  archive.put(archive.end() + 8, pack_limits::kFiles + 1, 2);
  archive.put(archive.end() + 10, pack_limits::kFiles + 1, 2);
  EXPECT_THAT(archive.refusal(), HasSubstr("at most 10000 are read"));
  entries.push_back({.name = "more", .content = ""});
  EXPECT_THROW(write_zip(entries), ZipError);
}

TEST(Zip, RefusesEveryTruncation) {
  const std::string whole = write_zip(kEntries);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(Archive{.bytes = whole.substr(0, size)}.refusal(), "") << size;
  }
}

/// A changed byte is refused, or is in a part that means nothing here, such as a date.
TEST(Zip, NeverReadsOtherContentsFromADamagedArchive) {
  const std::string whole = write_zip(kEntries);
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (const int change : {0x01, 0x10, 0x80, 0xFF}) {
      std::string bytes = whole;
      bytes[at] = static_cast<char>(bytes[at] ^ change);
      try {
        EXPECT_EQ(read_zip(bytes, {}), kEntries) << "byte " << at << " ^ " << change;
      } catch (const ZipError&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, static_cast<int>(whole.size()) * 3);
}

TEST(Zip, WritesNoNamesThatAreNotRead) {
  for (const char* name : {"", "../a", "/a", "a\\b", "C:a", "a\nb", "\xff"}) {
    EXPECT_NE(refusal_of_entry_name(name), "") << name;
    EXPECT_THROW(write_zip({{.name = name, .content = ""}}), ZipError) << name;
  }
  for (const char* name : {"a", "...", "..a/b..", "ab:c", ".hidden", "a b/c"}) {
    EXPECT_EQ(refusal_of_entry_name(name), "") << name;
  }
}

}  // namespace
}  // namespace sdlc::lang
