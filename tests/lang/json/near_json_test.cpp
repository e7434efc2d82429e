#include "lang/json/near_json.hpp"

#include <gtest/gtest.h>

#include "lang/json/tape.hpp"

namespace sdlc::lang {
namespace {

TEST(NearNumber, KeepsTheValue) {
  EXPECT_EQ(near_number("+1.50").text, "1.50");
  EXPECT_EQ(near_number("000").text, "0");
  EXPECT_EQ(near_number("-00.5e3").text, "-0.5e3");
  EXPECT_EQ(near_number("1_000.5").text, "1000.5");
  EXPECT_EQ(near_number("-0XfF").text, "-255");
  EXPECT_EQ(near_number("0x").text, std::nullopt);
  EXPECT_EQ(near_number("0xFFFFFFFFFFFFFFFFF").text, std::nullopt);
  EXPECT_EQ(near_number(".").text, std::nullopt);
  EXPECT_EQ(near_number("1e+").text, std::nullopt);
}

TEST(QuoteForJson, TurnsOtherQuotesIntoItsOwn) {
  EXPECT_EQ(quote_for_json(R"(it\'s "it")"), R"("it's \"it\"")");
  EXPECT_EQ(quote_for_json(R"(\\")"), R"("\\\"")");
  EXPECT_EQ(quote_for_json(R"(\n)"), R"("\n")");
}

TEST(Unescape, ResolvesEveryEscape) {
  EXPECT_EQ(unescape(R"(a\"\\\/\b\f\n\r\tz)"), "a\"\\/\b\f\n\r\tz");
  EXPECT_EQ(unescape(R"(\u0041\u00e9\u20ac\ud83d\ude00)"), "Aé€😀");
}

TEST(Unescape, ReadsWrongEscapesAsTheirCharacters) {
  EXPECT_EQ(unescape(R"(\q\')"), "q'");
  EXPECT_EQ(unescape(R"(\ud83dx)"), "\uFFFDx");
  EXPECT_EQ(unescape(R"(\ud800\u12)"), "\uFFFD\uFFFD12");
  EXPECT_EQ(unescape("\\"), "");
}

}  // namespace
}  // namespace sdlc::lang
