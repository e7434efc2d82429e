#include "lang/object/value.hpp"

#include <string>

#include <gtest/gtest.h>

namespace sdlc::lang {
namespace {

TEST(ToText, IsTheShortestThatReadsBack) {
  EXPECT_EQ(to_text(0.1), "0.1");
  EXPECT_EQ(to_text(-0.0), "0");
  EXPECT_EQ(to_text(255.0), "255");
  EXPECT_EQ(to_text(1e10), "1e10");
  EXPECT_EQ(to_text(1e-7), "1e-7");
  EXPECT_EQ(to_text(5e-324), "5e-324");
  EXPECT_EQ(to_text(1.7976931348623157e308), "1.7976931348623157e308");
}

TEST(ToText, SpellsValuesAsTheLanguageDoes) {
  EXPECT_EQ(to_text(Value(true)), "true");
  EXPECT_EQ(to_text(Value(std::string("a\"\n"))), R"("a\"\n")");
  EXPECT_EQ(to_text(Value(Triple{{1, -0.0, 2.5}})), "(1, 0, 2.5)");
  EXPECT_EQ(to_text(Value(Scalar{-1})), "-1");
  EXPECT_EQ(to_text(Value(Scalar{2, Unit::Length})), "2m");
  EXPECT_EQ(to_text(Value(Angle{40})), "40deg");
  EXPECT_EQ(to_text(Value(render::LinearRgb{1, 0, 0.5})), "linear(1, 0, 0.5)");
  EXPECT_EQ(to_text(Value(Bounds{0, 0.5})), "0 .. 0.5");
  EXPECT_EQ(to_text(Value(MaterialValue{MaterialKind::Specular, render::LinearRgb{1}, 0.5, false})),
            "specular(color: linear(1, 1, 1), fuzz: 0.5)");
  EXPECT_EQ(to_text(Value(MotionValue{{1, 2, 3}, {0, 1}})), "line(to: (1, 2, 3), over: 0 .. 1)");
}

}  // namespace
}  // namespace sdlc::lang
