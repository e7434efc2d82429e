#include "lang/math/random.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/lang/math/arguments.hpp"

namespace sdlc::lang {
namespace {

TEST(Random, HasTheValuesOfTheSpecification) {
  EXPECT_EQ(RandomHash().add_number(1).uniform(), 0.73087526727066165);
  EXPECT_EQ(RandomHash().add_number(1).add_number(2).uniform(), 0.10157249976416438);
  EXPECT_EQ(RandomHash().add_number(0).uniform(), 0.36818951565166946);
  EXPECT_EQ(RandomHash().add_string("ball").add_number(0.5).uniform(), 0.74756360267880151);
  EXPECT_EQ(RandomHash().add_vec3({1, 2, 3}).uniform(), 0.094651159579525301);
}

TEST(Random, TakesEveryType) {
  // From a second implementation, in Python.
  EXPECT_EQ(RandomHash().add_bool(true).uniform(), 0.8766756214195504);
  EXPECT_EQ(RandomHash().add_bool(false).uniform(), 0.3922164624235318);
  EXPECT_EQ(RandomHash().add_angle(1).uniform(), 0.5169806670905995);
  EXPECT_EQ(RandomHash().add_string("").uniform(), 0.7375181681915192);
  EXPECT_EQ(RandomHash().add_string("12345678").uniform(), 0.8580446143906214);
  EXPECT_EQ(RandomHash().add_string("123456789").uniform(), 0.29695135141184115);
  EXPECT_EQ(RandomHash().add_string("\u00e9").uniform(), 0.9207498977515715);
}

TEST(Random, TakesMinusZeroForZero) {
  EXPECT_EQ(RandomHash().add_number(-0.0).uniform(), RandomHash().add_number(0).uniform());
  EXPECT_EQ(RandomHash().add_angle(-0.0).uniform(), RandomHash().add_angle(0).uniform());
  EXPECT_EQ(RandomHash().add_vec3({-0.0, 1, -0.0}).uniform(),
            RandomHash().add_vec3({0, 1, 0}).uniform());
}

TEST(Noise, HasTheValuesOfTheSpecification) {
  // From a second implementation, in Python.
  EXPECT_EQ(noise({0.5, 0.25, 0.75}), 0.3815970819668423);
  EXPECT_EQ(noise({-1.25, 3.5, 100.1}), -0.509008277453363);
  EXPECT_EQ(noise({1e17, -0.3, 0}), -0.017919306586831968);
}

TEST(Noise, IsTheRandomNumberAtALatticePoint) {
  const double random =
      RandomHash().add_string("noise").add_number(1).add_number(2).add_number(3).uniform();
  EXPECT_EQ(noise({1, 2, 3}), 2 * random - 1);
}

TEST(Noise, IsSmooth) {
  // The weight's slope is at most 15/8, and two corners differ by at most 2.
  constexpr double kStep = 1e-6;
  Arguments arguments;
  for (int i = 0; i < 10000; ++i) {
    const double x = arguments.between(-3, 3), y = arguments.between(-3, 3),
                 z = arguments.between(-3, 3);
    const double value = noise({x, y, z});
    EXPECT_LE(std::fabs(value), 1);
    EXPECT_LE(std::fabs(noise({x + kStep, y, z}) - value), 3.76 * kStep);
    EXPECT_LE(std::fabs(noise({x, y + kStep, z}) - value), 3.76 * kStep);
    EXPECT_LE(std::fabs(noise({x, y, z + kStep}) - value), 3.76 * kStep);
  }
}

}  // namespace
}  // namespace sdlc::lang
