#include "lang/editor/signature_help.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/lang/editor/marked_scene.hpp"

namespace sdlc::test {
namespace {

/// "mix(a, *b*, t)": the active signature with its active parameter in stars; "" without help.
std::string help(std::string_view text) {
  MarkedScene scene("scene 1\n" + std::string(text));
  const auto help = lang::signature_help(scene.view(), scene.file(), scene.offset());
  if (!help) return "";
  const lang::Signature& signature = help->signatures[help->active_signature];
  std::string label = signature.label;
  if (!help->active_parameter) return label;
  const lang::Span where = signature.parameters[*help->active_parameter].where;
  return label.insert(where.end, "*").insert(where.begin, "*");
}

TEST(SignatureHelp, FollowsThePosition) {
  EXPECT_EQ(help("let x = mix(|"), "mix(*a*, b, t)");
  EXPECT_EQ(help("let x = mix(1, |2, 3)"), "mix(a, *b*, t)");
  EXPECT_EQ(help("let x = mix(1, 2, 3, |"), "mix(a, b, t)");
  EXPECT_EQ(help("let x = min(1, 2, 3, |"), "min(a, b, *…*)");
  EXPECT_EQ(help("let x = range(1, |"), "range(a, *b*)");
}

TEST(SignatureHelp, FollowsTheName) {
  EXPECT_EQ(help("let m = specular(fuzz: |"), "specular(color, *fuzz: 0*)");
  EXPECT_EQ(help("let m = specular(fuzz: 1, |"), "specular(*color*, fuzz: 0)");
  EXPECT_EQ(help("let m = specular(fu|zz: 1, color: red)"), "specular(color, *fuzz: 0*)");
  EXPECT_EQ(help("let m = specular(red, fuzz: |"), "specular(color, *fuzz: 0*)");
  EXPECT_EQ(help("let m = specular(wrong: |"), "specular(color, fuzz: 0)");
}

TEST(SignatureHelp, ShowsFunctionsOfTheScene) {
  const std::string fn = "/// Doc.\nfn f(a: angle, b = 50%) = a\n";
  EXPECT_EQ(help(fn + "let x = f(1deg, |"), "f(a: angle, *b = 50%*)");
  EXPECT_EQ(help(fn + "let x = f(b: |"), "f(a: angle, *b = 50%*)");
  MarkedScene scene("scene 1\n" + fn + "let x = f(|");
  EXPECT_EQ(lang::signature_help(scene.view(), 0, scene.offset())->signatures[0].documentation,
            "Doc.");
}

TEST(SignatureHelp, IsThatOfTheInnermostCall) {
  EXPECT_EQ(help("let x = mix(max(1, 2), |"), "mix(a, *b*, t)");
  EXPECT_EQ(help("let x = mix(max(1, |"), "max(a, *b*, …)");
  EXPECT_EQ(help("let x = mix((1, 2, 3), [4, 5|"), "mix(a, *b*, t)");
  EXPECT_EQ(help("let x = str(\")(,\", |"), "str(x, *digits: …*, width: 0, fill: \" \")");
  EXPECT_EQ(help("let x = mix(/* ( */ 1, |"), "mix(a, *b*, t)");
}

TEST(SignatureHelp, IsNotShownOutsideOfCalls) {
  EXPECT_EQ(help("let x = mix(1, 2, 3)|"), "");
  EXPECT_EQ(help("let x = unknown(|"), "");
  EXPECT_EQ(help("fn f(|"), "");
  EXPECT_EQ(help("let x = (1, |"), "");
  EXPECT_EQ(help("sphere { radius: |"), "");
  EXPECT_EQ(help("sphere { material: diffuse(color: red\n}\nlet a = |1"), "");
}

}  // namespace
}  // namespace sdlc::test
