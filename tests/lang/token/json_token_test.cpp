#include <string>

#include <gtest/gtest.h>

#include "tests/lang/token/spelled_tokens.hpp"

namespace sdlc::lang {
namespace {

std::string tokens(std::string_view text) { return test::spelled(text, SourceFormat::Json); }

TEST(JsonToken, HasTheKindsOfTheStandard) {
  EXPECT_EQ(tokens("{\"a\": [-1.5e+3, true],\r\n\"\": \"\\\"\"}"),
            "open:{ string:\"a\" mark:: open:[ number:-1.5e+3 mark:, name:true close:] mark:, "
            "line end:\r\n string:\"\" mark:: string:\"\\\"\" close:}");
}

TEST(JsonToken, HasTheKindsOfOtherHabits) {
  EXPECT_EQ(tokens("radius = 'a' // c\n#d"),
            "name:radius mark:= string:'a' comment:// c line end:\n comment:#d");
  EXPECT_EQ(tokens("\u201Ca\u201D\u00A01/3 /* b"),
            "string:\u201Ca\u201D number:1/3 open block:/* b");
  EXPECT_EQ(tokens("0x1F +.5 1_000 /* b */ ;"),
            "number:0x1F number:+.5 number:1_000 block:/* b */ unknown:;");
}

TEST(JsonToken, EndsAnUnclosedStringWithItsLine) {
  EXPECT_EQ(tokens("\"a, 'b\n'c"), "open string:\"a, 'b line end:\n open string:'c");
}

}  // namespace
}  // namespace sdlc::lang
