#include "cli/amounts.hpp"

#include <cstddef>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/command_line.hpp"

namespace sdlc::cli {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// The message for a text; empty if it is valid.
template <typename Parse>
std::string complaint(Parse parse, const std::string& text) {
  try {
    parse("--flag", text);
    return {};
  } catch (const ArgumentError& error) {
    return error.what();
  }
}

struct Good {
  const char* text;
  double value;
};

/// The rejected text and the suggestion; empty if there is none.
struct Bad {
  const char* text;
  const char* meant;
};

template <typename Parse, std::size_t N>
void expect_refused(Parse parse, const Bad (&all)[N]) {
  for (const auto& [text, meant] : all) {
    const std::string told = complaint(parse, text);
    EXPECT_THAT(told, StartsWith("--flag: takes ")) << "`" << text << "`";
    const std::string suggestion = "(did you mean `" + std::string(meant) + "`?)";
    if (*meant == '\0') {
      EXPECT_THAT(told, Not(HasSubstr("did you mean"))) << text;
    } else {
      EXPECT_THAT(told, EndsWith(suggestion)) << text;
    }
  }
}

TEST(Amounts, ARatioMayBeAboveOne) {
  for (const auto& [text, value] : {Good{"250%", 2.5}, Good{"2.5", 2.5}, Good{"3%", 0.03},
                                    Good{"0.03", 0.03}, Good{"100%", 1}, Good{"0", 0}}) {
    EXPECT_EQ(parse_ratio("--flag", text), value) << text;
  }
  for (const char* text : {"", "%", "x", "-1", "-1%", "nan", "inf", "1e999", "3 %", "3%%", "0x1"}) {
    EXPECT_THAT(complaint(parse_ratio, text), StartsWith("--flag: takes a ratio from 0 on"))
        << text;
  }
}

TEST(Amounts, AShareIsANumberOrAPercentage) {
  for (const auto& [text, value] :
       {Good{"3%", 0.03}, Good{"0.03", 0.03}, Good{"0.5%", 0.005}, Good{".5%", 0.005},
        Good{"100%", 1}, Good{"1", 1}, Good{"1e-3", 0.001}, Good{"1e1%", 0.1}}) {
    EXPECT_EQ(parse_share("--flag", text), value) << text;
  }
}

TEST(Amounts, OtherTextsAreNoShares) {
  expect_refused(
      parse_share,
      {{"", ""},      {"%", ""},      {"1%%", ""},    {"1e3%", ""},   {"100.5%", ""},
       {"nan", ""},   {"inf", ""},    {"inf%", ""},   {"-1%", ""},    {"+1%", ""},
       {"0", ""},     {"0%", ""},     {"0x1p-3", ""}, {"1e-400", ""}, {"4e-324%", ""},
       {"1e400", ""}, {"1e400%", ""}, {"3s", ""},     {"0.03.1", ""}, {"1,5%", ""},
       {"10", "10%"}, {"3", "3%"},    {" 3%", "3%"},  {"3 %", "3%"},  {" 0.03", "0.03"}});
}

TEST(Amounts, ADurationIsANumberWithItsUnit) {
  for (const auto& [text, value] :
       {Good{"10s", 10}, Good{"500ms", 0.5}, Good{"2min", 120}, Good{"1h", 3600},
        Good{"1.5h", 5400}, Good{"0.1s", 0.1}, Good{"1ms", 0.001}, Good{"1e3ms", 1}}) {
    EXPECT_EQ(parse_duration("--flag", text), value) << text;
  }
}

TEST(Amounts, OtherTextsAreNoDurations) {
  expect_refused(parse_duration, {{"", ""},
                                  {"s", ""},
                                  {"%", ""},
                                  {"1%%", ""},
                                  {"nan", ""},
                                  {"nans", ""},
                                  {"inf", ""},
                                  {"infs", ""},
                                  {"-1s", ""},
                                  {"0", ""},
                                  {"0s", ""},
                                  {"1e400s", ""},
                                  {"1e308h", ""},
                                  {"1e-400s", ""},
                                  {"4e-324ms", ""},
                                  {"1m30s", ""},
                                  {"10d", ""},
                                  {"10", "10s"},
                                  {"10 s", "10s"},
                                  {" 10s", "10s"},
                                  {"10sec", "10s"},
                                  {"10S", "10s"},
                                  {"2m", "2min"},
                                  {"2 minutes", "2min"},
                                  {"1hour", "1h"},
                                  {"500msec", "500ms"},
                                  {"500 milliseconds", "500ms"}});
}

TEST(Amounts, WhatIsRefusedIsShownWithoutItsControlCharacters) {
  EXPECT_THAT(complaint(parse_share, "3\x1b%"), Not(HasSubstr("\x1b")));
}

TEST(Number, IsAnyFromTheLeastOn) {
  EXPECT_EQ(parse_number("--flag", "0", 0), 0);
  EXPECT_EQ(parse_number("--flag", "2.5e-3", 0), 0.0025);
  EXPECT_EQ(parse_number("--flag", "1", 1), 1);
}

TEST(Number, RejectsOtherTextAndNamesWhatItTakes) {
  const auto from_one = [](const std::string& flag, const std::string& text) {
    return parse_number(flag, text, 1);
  };
  for (const char* text : {"", "x", "0.5", "-3", "2x", " 2", "nan", "inf", "1e999"}) {
    EXPECT_THAT(complaint(from_one, text), StartsWith("--flag: takes a number from 1 on, such as "
                                                      "`1.5`, not `"))
        << text;
  }
}

TEST(Number, MayBeOfAnySignOrAboveZero) {
  EXPECT_EQ(parse_signed_number("--flag", "-3.5"), -3.5);
  EXPECT_EQ(parse_positive_number("--flag", "1e-9"), 1e-9);
  for (const char* text : {"", "x", "inf", "-1e999"}) {
    EXPECT_THAT(complaint(parse_signed_number, text), StartsWith("--flag: takes a number, such as"))
        << text;
  }
  for (const char* text : {"", "0", "-1", "nan"}) {
    EXPECT_THAT(complaint(parse_positive_number, text),
                StartsWith("--flag: takes a number above 0, such as"))
        << text;
  }
}

}  // namespace
}  // namespace sdlc::cli
