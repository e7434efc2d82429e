#include "tests/support/reference/scatter.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/statistics/estimate.hpp"

namespace sdlc::test::reference {
namespace {

/// Means over many vertices; three numbers at a time in the channels of an Estimate.
template <typename Function>
test::Estimate mean_of(int samples, Function&& function) {
  test::EstimateBuilder builder;
  const std::uint64_t key = stream_key(11, 0, 0);
  for (int i = 0; i < samples; ++i) {
    const PathSampler path(SamplerKind::Independent, key, static_cast<std::uint32_t>(i));
    builder.add(function(VertexSampler(path, 2)));
  }
  return builder.estimate();
}

// H0: uniform on the sphere, so E[x] = 0 and E[x²] = 1/3. Significance 1e-4 each.
TEST(SampleUnitSphere, HasTheMomentsOfTheUniformDistribution) {
  const auto first = mean_of(1 << 18, [](const VertexSampler& sample) {
    const Vec3 v = sample_unit_sphere(sample);
    EXPECT_NEAR(length(v), 1, 1e-15);
    return LinearRgb{v.x, v.y, v.z};
  });
  EXPECT_TRUE(agrees(first, LinearRgb{0}));
  const auto second = mean_of(1 << 18, [](const VertexSampler& sample) {
    const Vec3 v = sample_unit_sphere(sample);
    return LinearRgb{v.x * v.x, v.y * v.y, v.z * v.z};
  });
  EXPECT_TRUE(agrees(second, LinearRgb{1.0 / 3}));
}

// H0: uniform in the ball, so E[r] = 3/4, E[r²] = 3/5 and P(r < 1/2) = 1/8.
TEST(SampleUnitBall, HasTheRadiiOfTheUniformDistribution) {
  const auto radii = mean_of(1 << 18, [](const VertexSampler& sample) {
    const double r = length(sample_unit_ball(sample));
    return LinearRgb{r, r * r, r < 0.5 ? 1.0 : 0.0};
  });
  EXPECT_TRUE(agrees(radii, {0.75, 0.6, 0.125}));
}

// H0: density cos θ / π, so E[cos θ] = 2/3, E[cos² θ] = 1/2 and P(θ < 45°) = 1/2.
TEST(ScatterDiffuse, FollowsTheCosineLaw) {
  const Vec3 normal = unit({1, 2, -0.5});
  const auto cosines = mean_of(1 << 18, [&](const VertexSampler& sample) {
    const double cosine = dot(scatter_diffuse(normal, sample), normal);
    return LinearRgb{cosine, cosine * cosine, cosine > std::sqrt(0.5) ? 1.0 : 0.0};
  });
  EXPECT_TRUE(agrees(cosines, {2.0 / 3, 0.5, 0.5}));
}

TEST(ScatterTransmissive, BendsByTheLawOfSnell) {
  const Vec3 outward{0, 1, 0};
  const double sine = 0.6;
  const PathSampler path(SamplerKind::Sobol, stream_key(0, 0, 0), 1);
  for (int vertex = 0; vertex < 100; ++vertex) {
    const VertexSampler sample(path, vertex);
    const Vec3 in{sine, -std::sqrt(1 - sine * sine), 0};
    const Vec3 out = scatter_transmissive(in, outward, 1.5, Fresnel::Schlick, sample);
    if (out.y > 0) {
      EXPECT_NEAR(out.x, sine, 1e-15) << "reflected";
    } else {
      EXPECT_NEAR(out.x, sine / 1.5, 1e-15) << "refracted";
    }
  }
}

TEST(ScatterTransmissive, ReflectsBeyondTheCriticalAngle) {
  const PathSampler path(SamplerKind::Sobol, stream_key(0, 0, 0), 1);
  const double sine = 0.7;  // 1 / 1.5 is the limit
  const Vec3 in{sine, std::sqrt(1 - sine * sine), 0};
  for (int vertex = 0; vertex < 100; ++vertex) {
    const Vec3 out =
        scatter_transmissive(in, {0, 1, 0}, 1.5, Fresnel::Exact, VertexSampler(path, vertex));
    EXPECT_LT(out.y, 0);
  }
}

TEST(FresnelExact, MeetsItsKnownValues) {
  EXPECT_NEAR(fresnel_exact(1, 1 / 1.5), 0.04, 1e-15);
  EXPECT_NEAR(fresnel_exact(0, 1 / 1.5), 1, 1e-15);
  EXPECT_NEAR(fresnel_exact(0.5, 1), 0, 1e-15);
  // At Brewster's angle, tan θ = 1.5, light polarised in the plane of incidence is not reflected.
  const double cosine = 1 / std::sqrt(1 + 1.5 * 1.5), across = (1 - 1.5 * 1.5) / (1 + 1.5 * 1.5);
  EXPECT_NEAR(fresnel_exact(cosine, 1 / 1.5), across * across / 2, 1e-15);
}

}  // namespace
}  // namespace sdlc::test::reference
