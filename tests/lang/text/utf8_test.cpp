#include "lang/text/utf8.hpp"

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(Utf8, ReadsBackEveryCodePoint) {
  for (char32_t c = 0; c <= 0x10FFFF; ++c) {
    if (c >= 0xD800 && c <= 0xDFFF) continue;
    std::string text;
    append_utf8(c, text);
    const DecodedChar decoded = decode_utf8(text + "x");
    ASSERT_TRUE(decoded.is_valid) << static_cast<std::uint32_t>(c);
    ASSERT_EQ(decoded.code_point, c);
    ASSERT_EQ(decoded.size, text.size());
  }
}

TEST(Utf8, RefusesWhatIsNone) {
  for (const char* bad :
       {"\x80", "\xbf", "\xc0\x80", "\xc1\xbf", "\xc3", "\xc3(", "\xe0\x80\x80", "\xe2\x82",
        "\xed\xa0\x80", "\xf0\x80\x80\x80", "\xf4\x90\x80\x80", "\xf5\x80\x80\x80", "\xff"}) {
    EXPECT_FALSE(decode_utf8(bad).is_valid) << bad;
    EXPECT_EQ(decode_utf8(bad).size, 1u);
  }
}

TEST(Utf8, CountsCodePoints) {
  EXPECT_EQ(count_code_points(""), 0u);
  EXPECT_EQ(count_code_points("aé日😀"), 4u);
  EXPECT_EQ(count_code_points("a\xff\xe2\x82"), 4u);
}

}  // namespace
}  // namespace sdlc::lang
