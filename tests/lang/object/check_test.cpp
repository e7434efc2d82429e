#include "lang/object/check.hpp"

#include <gtest/gtest.h>

#include "lang/report/report.hpp"

namespace sdlc::lang {
namespace {

const SourceFile kFile("a.scene", "value\n");
const Location kWhere{&kFile, {0, 5}};

/// The diagnostic of check_value, or nothing.
std::string complaint(Type type, Range range, const Value& value) {
  DiagnosticSink sink;
  const bool is_good = check_value("it", type, range, value, kWhere, sink);
  EXPECT_EQ(is_good, !sink.has_errors());
  return is_good ? "" : sink.diagnostics().front().message;
}

TEST(CheckValue, WantsTheType) {
  EXPECT_EQ(complaint(Type::Length, Range::Any, Scalar{1.5}), "");
  EXPECT_EQ(complaint(Type::Number, Range::Any, true), "`it` takes a number, not true or false");
  EXPECT_EQ(complaint(Type::Color, Range::Any, Triple{}),
            "`it` takes a colour, not a point (x, y, z)");
}

TEST(CheckValue, WantsAUnitThatTheTypeTakes) {
  EXPECT_EQ(complaint(Type::Length, Range::Any, Scalar{1, Unit::Length}), "");
  EXPECT_EQ(complaint(Type::Number, Range::Any, Scalar{1, Unit::Length}),
            "`it` takes a number, not a length");
  EXPECT_EQ(complaint(Type::Length, Range::Any, Scalar{1, Unit::Time}),
            "`it` takes a length, not a time");
  EXPECT_EQ(complaint(Type::Interval, Range::Any, Bounds{0, 1, Unit::Time}), "");
  EXPECT_EQ(complaint(Type::Frames, Range::Any, Bounds{0, 1, Unit::Time}),
            "`it` takes an interval of frames, not an interval a .. b");
}

TEST(CheckValue, WantsTheRange) {
  EXPECT_EQ(complaint(Type::Length, Range::NonNegative, Scalar{0.0}), "");
  EXPECT_EQ(complaint(Type::Length, Range::NonNegative, Scalar{-1.0}),
            "`it` must be at least 0, not -1");
  EXPECT_EQ(complaint(Type::Number, Range::Positive, Scalar{0.0}),
            "`it` must be greater than 0, not 0");
  EXPECT_EQ(complaint(Type::Angle, Range::BetweenZeroAndHalfTurn, Angle{180}),
            "`it` must be greater than 0 and less than 180 degrees, not 180deg");
  EXPECT_EQ(complaint(Type::Color, Range::NonNegative, render::LinearRgb{2, 0, -1}),
            "`it` must be at least 0, not -1");
}

TEST(CheckValue, WantsWholeNumbersThatFit) {
  EXPECT_EQ(complaint(Type::WholeNumber, Range::AtLeastOne, Scalar{2.5}),
            "`it` takes a whole number, not 2.5");
  EXPECT_EQ(complaint(Type::WholeNumber, Range::AtLeastOne, Scalar{0.0}),
            "`it` must be at least 1, not 0");
  EXPECT_EQ(complaint(Type::WholeNumber, Range::AtLeastOne, Scalar{kMaxWholeNumber}), "");
  EXPECT_EQ(complaint(Type::WholeNumber, Range::AtLeastOne, Scalar{1e10}),
            "`it` must be at most 1000000000, not 1e10");
  EXPECT_EQ(complaint(Type::WholeNumber, Range::NonNegativeExact, Scalar{0x1p53}), "");
  EXPECT_EQ(complaint(Type::WholeNumber, Range::NonNegativeExact, Scalar{0x1p54}),
            "`it` must be from 0 to 9007199254740992, not 18014398509481984");
}

TEST(CheckValue, IsSilentAboutWhatHasBeenReported) {
  DiagnosticSink sink;
  EXPECT_FALSE(check_value("it", Type::Number, Range::Any, {}, kWhere, sink));
  EXPECT_FALSE(sink.has_errors());
}

TEST(CheckValue, WantsAMotionToTakeTime) {
  EXPECT_EQ(complaint(Type::Motion, Range::Any, MotionValue{{}, {1, 1}}),
            "the interval of `it` is empty: both ends are 1");
}

TEST(CheckProperty, KnowsNoneAndWords) {
  const auto camera = kind_info(ObjectKind::Camera).properties;
  const auto render = kind_info(ObjectKind::Render).properties;
  DiagnosticSink sink;
  EXPECT_TRUE(check_property(camera[camera_property::kShutter], None{}, kWhere, sink));
  EXPECT_FALSE(check_property(camera[camera_property::kFov], None{}, kWhere, sink));
  EXPECT_TRUE(check_property(render[render_property::kCamera], Word{"any"}, kWhere, sink));
  EXPECT_FALSE(check_property(render[render_property::kTone], Word{"sqr"}, kWhere, sink));
  EXPECT_EQ(sink.diagnostics().back().suggestion, "sqrt");
}

}  // namespace
}  // namespace sdlc::lang
