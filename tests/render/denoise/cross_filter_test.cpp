#include "render/denoise/cross_filter.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include <gtest/gtest.h>

#include "render/kernel/backend.hpp"
#include "tests/render/denoise/noisy_film.hpp"
#include "tests/support/statistics/random.hpp"

namespace sdlc::render {
namespace {

ReplicatePlanes noisy_planes(int width, int height) {
  const test::Limit limit = test::two_halves(width, height);
  ReplicatePlanes planes{.width = width, .height = height, .means = {}, .features = {}};
  test::Random random(7);
  for (auto& replicate : planes.means) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (const LinearRgb& value : limit) {
        replicate[c].push_back(static_cast<float>(value.g + random.between(-0.5, 0.5)));
      }
    }
  }
  for (auto& feature : planes.features) {
    for (std::size_t i = 0; i < limit.size(); ++i) {
      feature.push_back(static_cast<float>(random.between(0, 0.2)));
    }
  }
  return planes;
}

/// All pixels of a picture, tile by tile.
std::vector<FilteredPixel> filtered(CrossFilter& filter, const ReplicatePlanes& planes) {
  std::vector<FilteredPixel> all;
  for (int y = 0; y < planes.height; y += kFilterTile) {
    for (int x = 0; x < planes.width; x += kFilterTile) {
      const std::vector<FilteredPixel> tile =
          filter(planes, {x, y, std::min(x + kFilterTile, planes.width),
                          std::min(y + kFilterTile, planes.height)});
      all.insert(all.end(), tile.begin(), tile.end());
    }
  }
  return all;
}

TEST(CrossFilter, GivesTheSameBytesWithEveryInstructionSet) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 2}, {32, 32}, {37, 67}}) {
    const ReplicatePlanes planes = noisy_planes(width, height);
    const std::vector<FilteredPixel> expected = filtered(portable_filter, planes);
    for (const Backend& backend : backends()) {
      if (!backend.is_available()) continue;
      const std::vector<FilteredPixel> pixels = filtered(*backend.filter, planes);
      ASSERT_EQ(pixels.size(), expected.size());
      EXPECT_EQ(std::memcmp(pixels.data(), expected.data(), pixels.size() * sizeof(FilteredPixel)),
                0)
          << backend.name << ", " << width << " x " << height;
    }
  }
}

TEST(CrossFilter, DoesNotDependOnTiles) {
  const ReplicatePlanes planes = noisy_planes(40, 20);
  const FilteredPixel in_tile = portable_filter(planes, {8, 0, 40, 20})[20 * 0 + 10];
  const FilteredPixel alone = portable_filter(planes, {18, 0, 19, 1})[0];
  EXPECT_EQ(std::memcmp(&in_tile, &alone, sizeof alone), 0);
}

// The estimate of the error is unbiased because of this.
TEST(CrossFilter, DoesNotReadTheReplicateThatItLeavesOut) {
  const ReplicatePlanes planes = noisy_planes(20, 20);
  const std::vector<FilteredPixel> expected = portable_filter(planes, {0, 0, 20, 20});
  for (std::size_t r = 0; r < kReplicates; ++r) {
    ReplicatePlanes changed = planes;
    for (auto& plane : changed.means[r]) {
      for (float& value : plane) value = 3 - value;
    }
    const std::vector<FilteredPixel> pixels = portable_filter(changed, {0, 0, 20, 20});
    bool has_changed = false;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      EXPECT_EQ(pixels[i].without[r], expected[i].without[r]);
      has_changed |=
          pixels[i].without[(r + 1) % kReplicates] != expected[i].without[(r + 1) % kReplicates];
    }
    EXPECT_TRUE(has_changed) << r;
  }
}

TEST(CrossFilter, KeepsWhatHasNoNoise) {
  ReplicatePlanes planes = noisy_planes(20, 20);
  for (std::size_t r = 1; r < kReplicates; ++r) planes.means[r] = planes.means[0];
  const std::vector<FilteredPixel> pixels = portable_filter(planes, {0, 0, 20, 20});
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_NEAR(pixels[i].own_weight, 1, 1e-5);
    for (std::size_t r = 0; r < kReplicates; ++r) {
      EXPECT_NEAR(pixels[i].without[r][0], planes.means[0][0][i], 1e-5);
    }
  }
}

/// How much the green of the pixels right of an edge rises if that of the others rises by 1.
double bleeding(const ReplicatePlanes& planes) {
  ReplicatePlanes changed = planes;
  for (auto& replicate : changed.means) {
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 10; ++x) replicate[1][changed.index(x, y)] += 1;
    }
  }
  const std::vector<FilteredPixel> before = portable_filter(planes, {10, 0, 13, 20}),
                                   after = portable_filter(changed, {10, 0, 13, 20});
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    for (std::size_t r = 0; r < kReplicates; ++r) {
      sum += after[i].without[r][1] - before[i].without[r][1];
    }
  }
  return sum / static_cast<double>(kReplicates * before.size());
}

TEST(CrossFilter, KeepsEdgesOfFeatures) {
  ReplicatePlanes planes = noisy_planes(20, 20);
  test::Random random(11);
  for (auto& replicate : planes.means) {
    for (auto& plane : replicate) {
      for (float& value : plane) value = static_cast<float>(random.between(-5, 5));
    }
  }
  for (auto& feature : planes.features) std::ranges::fill(feature, 0.f);
  EXPECT_GT(bleeding(planes), 0.1);
  for (int y = 0; y < 20; ++y) {
    for (int x = 10; x < 20; ++x) planes.features[3][planes.index(x, y)] = 1;
  }
  EXPECT_NEAR(bleeding(planes), 0, 0.03);
}

}  // namespace
}  // namespace sdlc::render
