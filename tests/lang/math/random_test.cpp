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

TEST(Noise, OfOneOctaveIsNoise) {
  EXPECT_EQ(noise({0.5, 0.25, 0.75}, 1), noise({0.5, 0.25, 0.75}));
}

TEST(Noise, OfOctavesIsTheWeightedSum) {
  const render::Vec3 p{0.5, 0.25, 0.75}, shift{101.618, 57.414, 211.732};
  const double sum = noise(p) + noise(p * 2 + shift) / 2 + noise(p * 4 + shift * 2) / 4;
  EXPECT_EQ(noise(p, 3), sum / 1.75);
}

TEST(Noise, OfOctavesStaysWithinOne) {
  Arguments arguments;
  for (int i = 0; i < 10000; ++i) {
    const render::Vec3 p{arguments.between(-9, 9), arguments.between(-9, 9),
                         arguments.between(-9, 9)};
    EXPECT_LE(std::fabs(noise(p, 32)), 1);
  }
}

/// The mean and the mean square of a number that depends on i, over i = 0 … kSamples - 1.
constexpr int kSamples = 100'000;
struct Moments {
  double mean = 0, square = 0;
};
template <typename Function>
Moments moments_of(Function function) {
  Moments moments;
  for (int i = 0; i < kSamples; ++i) {
    const double x = function(RandomHash().add_string("moments").add_number(i));
    moments.mean += x / kSamples;
    moments.square += x * x / kSamples;
  }
  return moments;
}

/// H0: the mean is `expected`, of numbers with this standard deviation. 5 standard errors: each
/// comparison fails by chance once in 1.7 million.
void expect_mean(double mean, double expected, double deviation) {
  EXPECT_NEAR(mean, expected, 5 * deviation / std::sqrt(kSamples));
}

TEST(RandomPoints, AreUniformInTheDisc) {
  // x has mean 0 and variance 1/4; the squared radius is uniform in [0, 1).
  const auto x = moments_of([](const RandomHash& a) { return random_in_disc(a).x; });
  const auto y = moments_of([](const RandomHash& a) { return random_in_disc(a).y; });
  const auto r = moments_of([](const RandomHash& a) {
    const render::Vec3 p = random_in_disc(a);
    EXPECT_EQ(p.z, 0);
    EXPECT_LT(dot(p, p), 1 + 1e-15);
    return dot(p, p);
  });
  expect_mean(x.mean, 0, 0.5);
  expect_mean(y.mean, 0, 0.5);
  expect_mean(x.square, 1 / 4.0, 0.25);
  expect_mean(r.mean, 1 / 2.0, std::sqrt(1 / 12.0));
  expect_mean(r.square, 1 / 3.0, std::sqrt(4 / 45.0));
}

TEST(RandomPoints, AreUniformOnTheSphere) {
  // Each coordinate is uniform in [-1, 1] (Archimedes).
  for (double render::Vec3::*axis : {&render::Vec3::x, &render::Vec3::y, &render::Vec3::z}) {
    const auto c = moments_of([&](const RandomHash& a) {
      const render::Vec3 p = random_on_sphere(a);
      EXPECT_NEAR(dot(p, p), 1, 1e-15 * 4);
      return p.*axis;
    });
    expect_mean(c.mean, 0, std::sqrt(1 / 3.0));
    expect_mean(c.square, 1 / 3.0, std::sqrt(4 / 45.0));
  }
}

TEST(RandomPoints, AreUniformInTheSphere) {
  // Each coordinate has the variance 1/5; the cube of the radius is uniform.
  for (double render::Vec3::*axis : {&render::Vec3::x, &render::Vec3::y, &render::Vec3::z}) {
    const auto c = moments_of([&](const RandomHash& a) { return random_in_sphere(a).*axis; });
    expect_mean(c.mean, 0, std::sqrt(1 / 5.0));
    expect_mean(c.square, 1 / 5.0, std::sqrt(3 / 35.0 - 1 / 25.0));
  }
  const auto r = moments_of([](const RandomHash& a) {
    const render::Vec3 p = random_in_sphere(a);
    return std::pow(dot(p, p), 1.5);
  });
  expect_mean(r.mean, 1 / 2.0, std::sqrt(1 / 12.0));
  expect_mean(r.square, 1 / 3.0, std::sqrt(4 / 45.0));
}

TEST(RandomNumbers, AreNormal) {
  const auto x = moments_of(random_normal);
  expect_mean(x.mean, 0, 1);
  expect_mean(x.square, 1, std::sqrt(2));
  const auto square = moments_of([](const RandomHash& a) { return std::pow(random_normal(a), 2); });
  expect_mean(square.square, 3, std::sqrt(96));  // the fourth moment
  const auto tail = moments_of([](const RandomHash& a) { return random_normal(a) > 2 ? 1.0 : 0; });
  expect_mean(tail.mean, 0.022750132, std::sqrt(0.02275 * 0.97725));
}

TEST(RandomPoints, AreMadeOfTheDocumentedNumbers) {
  const auto u = [](std::string_view name, int i) {
    return RandomHash().add_number(7).add_string(name).add_number(i).uniform();
  };
  const RandomHash seven = RandomHash().add_number(7);
  const double degrees = 360 * u("random_in_disc", 1), radians = degrees / 180 * M_PI;
  EXPECT_NEAR(random_in_disc(seven).x, std::sqrt(u("random_in_disc", 0)) * std::cos(radians),
              1e-14);
  EXPECT_EQ(random_on_sphere(seven).z, 2 * u("random_on_sphere", 0) - 1);
  EXPECT_NEAR(length(random_in_sphere(seven)), std::cbrt(u("random_in_sphere", 2)), 1e-14);
  const double normal = std::sqrt(-2 * std::log(1 - u("random_normal", 0))) *
                        std::cos(2 * M_PI * u("random_normal", 1));
  EXPECT_NEAR(random_normal(seven), normal, 1e-14);
}

}  // namespace
}  // namespace sdlc::lang
