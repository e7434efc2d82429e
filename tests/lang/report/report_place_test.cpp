#include "lang/report/report_place.hpp"

#include <string>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(ReportPath, IsRelativeToTheRootWhereTheFileLiesInIt) {
  EXPECT_EQ(report_path("/home/tree/scenes/a.scene", "/home/tree"), "scenes/a.scene");
  EXPECT_EQ(report_path("./scenes/../a.scene", "/home/tree"), "a.scene");
  EXPECT_EQ(report_path("/elsewhere/a.scene", "/home/tree"), "/elsewhere/a.scene");
  EXPECT_EQ(report_path("../a.scene", "/home/tree"), "/home/a.scene");
  EXPECT_EQ(report_path("./a.scene", ""), "./a.scene");
}

TEST(ReportUri, EncodesAllButUnreservedCharactersAndSlashes) {
  EXPECT_EQ(report_uri("a b/ü#1?.scene"), "a%20b/%C3%BC%231%3F.scene");
  EXPECT_EQ(report_uri("<stdin>"), "%3Cstdin%3E");
  EXPECT_EQ(report_uri("/elsewhere/a.scene"), "file:///elsewhere/a.scene");
}

std::string fingerprint(const std::string& text, std::uint32_t line) {
  return LineFingerprints().of(SourceFile("a.scene", text), line);
}

// Values from an independent program, whose other values agree with GitHub's own tests.
TEST(LineFingerprints, AreThoseThatGitHubComputes) {
  EXPECT_EQ(fingerprint("", 1), "c129715d7a2bc9a3:1");
  EXPECT_EQ(fingerprint("scene 1\n\tsphere { radius: 0 }\n", 2), "957c759b751359ee:1");
  EXPECT_EQ(fingerprint("let a = \"é𝄞\"\r\nlet a = \"é𝄞\"\n", 1), "793cd96351d48823:1");
  EXPECT_EQ(fingerprint("let a = \"é𝄞\"\r\nlet a = \"é𝄞\"\n", 2), "43945af00a4f6f63:1");
}

TEST(LineFingerprints, NumberLinesThatLookAlike) {
  std::string text;
  for (int i = 0; i < 105; ++i) text += "x\n";
  EXPECT_EQ(fingerprint(text, 1), "c0fe7b2700d6c254:1");
  EXPECT_EQ(fingerprint(text, 3), "c0fe7b2700d6c254:3");
}

TEST(LineFingerprints, StayWhenLinesAreAddedAboveAndBlanksChange) {
  const std::string ball = "sphere { radius: 0 }\n";
  EXPECT_EQ(fingerprint(ball, 1), fingerprint("scene 1\n\n  sphere {radius:\t0}\n", 3));
  EXPECT_NE(fingerprint(ball, 1), fingerprint("sphere { radius: 1 }\n", 1));
}

TEST(LineFingerprints, AreOfTheFileAskedFor) {
  LineFingerprints fingerprints;
  const SourceFile a("a", "x\n"), b("b", "y\n");
  EXPECT_EQ(fingerprints.of(a, 1), fingerprint("x\n", 1));
  EXPECT_EQ(fingerprints.of(b, 1), fingerprint("y\n", 1));
}

TEST(LineFingerprints, KnowALineForAnyBytes) {
  EXPECT_FALSE(fingerprint("\xff\xfe\n\x80", 2).empty());
  EXPECT_FALSE(fingerprint("\xef\xbb\xbfscene 1", 1).empty());
}

}  // namespace
}  // namespace sdlc::lang
