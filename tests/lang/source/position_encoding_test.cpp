#include "lang/source/position_encoding.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

using enum PositionEncoding;

// Bytes: a 1, é 2, 😀 4, b 1, then a line end and "c".
const std::string kText = "aé😀b\r\nc";

TEST(PositionEncoding, CountsColumnsInItsUnits) {
  const SourceFile file("a.scene", kText);
  EXPECT_EQ(position_of(file, 7, Utf8), (Position{1, 8}));
  EXPECT_EQ(position_of(file, 7, Utf16), (Position{1, 5}));
  EXPECT_EQ(position_of(file, 7, Utf32), (Position{1, 4}));
  EXPECT_EQ(position_of(file, 10, Utf16), (Position{2, 1}));
  EXPECT_EQ(position_of(file, 11, Utf16), (Position{2, 2}));
  EXPECT_EQ(position_of(file, 999, Utf16), (Position{2, 2}));
}

TEST(PositionEncoding, FindsTheBeginningOfACodePoint) {
  const SourceFile file("a.scene", kText);
  for (std::uint32_t inside = 3; inside < 7; ++inside) {
    EXPECT_EQ(position_of(file, inside, Utf16), (Position{1, 3})) << inside;
  }
  EXPECT_EQ(offset_of(file, {1, 4}, Utf16), 3u);  // between the surrogates of 😀
  EXPECT_EQ(offset_of(file, {1, 5}, Utf8), 4u) << "bytes are exact";
}

TEST(PositionEncoding, InvertsItself) {
  const SourceFile file("a.scene", kText);
  for (const PositionEncoding encoding : {Utf8, Utf16, Utf32}) {
    for (const std::uint32_t offset : {0u, 1u, 3u, 7u, 8u, 10u, 11u}) {
      EXPECT_EQ(offset_of(file, position_of(file, offset, encoding), encoding), offset);
    }
  }
}

TEST(PositionEncoding, KeepsPositionsInsideTheText) {
  const SourceFile file("a.scene", kText);
  EXPECT_EQ(offset_of(file, {1, 99}, Utf16), 8u);  // before the line end
  EXPECT_EQ(offset_of(file, {99, 1}, Utf16), 11u);
  EXPECT_EQ(offset_of(file, {0, 0}, Utf16), 0u);
  EXPECT_EQ(offset_of(SourceFile("b.scene", ""), {1, 1}, Utf16), 0u);
}

TEST(PositionEncoding, SurvivesBrokenUtf8) {
  const SourceFile file("a.scene", "\x80\xF0\x9Fx");
  EXPECT_EQ(position_of(file, 3, Utf32), (Position{1, 2}));
  EXPECT_EQ(offset_of(file, {1, 2}, Utf32), 3u);
  EXPECT_EQ(position_of(file, 2, Utf8), (Position{1, 3}));
}

TEST(PositionMap, AgreesWithPositionOf) {
  // Lines of several kept columns, characters of every size across them, and broken UTF-8.
  std::string text = "a\n";
  while (text.size() < 9000) text += "aé😀\x80";
  text += "\nb\n";
  while (text.size() < 15'000) text += "😀";
  const SourceFile file("a.scene", text);
  for (const PositionEncoding encoding : {Utf8, Utf16, Utf32}) {
    PositionMap map(file, encoding);
    for (std::uint32_t i = 0; i < text.size() + 3; ++i) {
      // Forwards and backwards, through both long lines.
      const std::uint32_t offset = i * 7919 % static_cast<std::uint32_t>(text.size() + 3);
      ASSERT_EQ(map.at(offset), position_of(file, offset, encoding)) << offset;
    }
  }
}

}  // namespace
}  // namespace sdlc::lang
