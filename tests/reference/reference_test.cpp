#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "render/tiles/render.hpp"

// Pictures against those of an independent renderer, which come with the standard error of every
// pixel. They are not part of the repository; without them the tests are skipped.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

const fs::path kReferences = fs::path(SDLC_SOURCE_DIR) / ".." / "shared" / "reference";
constexpr int kReferenceSamples = 4096;
constexpr int kSamples = 256;
constexpr int kBlock = 8;

/// A picture in the PFM format, linear, rows from the bottom up.
struct Pfm {
  int width = 0, height = 0;
  std::vector<float> values;

  double at(int x, int y_from_top, int channel) const {
    const int row = height - 1 - y_from_top;
    return values[static_cast<std::size_t>((row * width + x) * 3 + channel)];
  }
};

Pfm read_pfm(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string kind, scale;
  Pfm picture;
  file >> kind >> picture.width >> picture.height >> scale;
  file.get();
  picture.values.resize(static_cast<std::size_t>(picture.width) *
                        static_cast<std::size_t>(picture.height) * 3);
  file.read(reinterpret_cast<char*>(picture.values.data()),
            static_cast<std::streamsize>(picture.values.size() * sizeof(float)));
  EXPECT_TRUE(file.good() && kind == "PF") << path;
  return picture;
}

double channel(render::LinearRgb c, int i) { return i == 0 ? c.r : i == 1 ? c.g : c.b; }

/// One channel of a block: sums over its pixels.
struct BlockComparison {
  double difference = 0;      ///< ours minus the reference
  double standard_error = 0;  ///< of the difference
  double rounding = 0;        ///< what the reference's 32-bit floats may hide
  /// Where the reference saw no noise at all in 4096 samples a pixel, a path that it never met may
  /// still be met here: up to 5 of radiance 1, as many as p = 7e-7 allows for 256 samples a pixel.
  /// 0 if our block is flat too.
  double rare_events = 0;
};

BlockComparison compare_block(const render::Picture& ours, const Pfm& mean, const Pfm& error,
                              int x0, int y0, int c) {
  BlockComparison block;
  double variance = 0;
  for (int y = y0; y < std::min(y0 + kBlock, mean.height); ++y) {
    for (int x = x0; x < std::min(x0 + kBlock, mean.width); ++x) {
      const double value = channel(ours.at(x, y), c);
      block.difference += value - mean.at(x, y, c);
      block.rounding += 0x1p-24 * value;
      const double sem = error.at(x, y, c);
      variance += sem * sem * (1 + static_cast<double>(kReferenceSamples) / kSamples);
      if (value != channel(ours.at(x0, y0), c)) block.rare_events = 5.0 / kSamples;
    }
  }
  block.standard_error = std::sqrt(variance);
  return block;
}

class Reference : public testing::TestWithParam<std::string> {};

// H0: both pictures estimate the same radiance. Block means of 8 × 8 pixels are divided by their
// standard error, that of the reference and, from it, that of 256 samples. Under H0 the mean square
// of the 1530 values is near 1 (its standard deviation .02 if they were normal; the bound of 1.25²
// leaves room for what small samples of skewed radiance do), and no |z| passes 6.5 (p = 8e-11
// each).
TEST_P(Reference, AgreesInBlockMeans) {
  const fs::path config = kReferences / "configs" / (GetParam() + ".json");
  if (!fs::exists(config)) GTEST_SKIP() << "the reference pictures are not here";

  std::ifstream stream(config);
  const lang::SourceFile source(config.string(),
                                std::string(std::istreambuf_iterator<char>(stream), {}));
  const Pfm mean = read_pfm(kReferences / (GetParam() + ".mean.pfm"));
  const Pfm error = read_pfm(kReferences / (GetParam() + ".sem.pfm"));
  lang::DiagnosticSink sink;
  const auto lowered =
      lang::compile(source, {.width = mean.width, .samples = kSamples}, sink);
  ASSERT_TRUE(lowered);
  ASSERT_EQ(lowered->settings.height, mean.height);
  render::RenderMonitor monitor;
  const render::RenderResult result = render::render(lowered->scene, lowered->settings, monitor);
  EXPECT_EQ(result.nonfinite_samples, 0u);

  double sum_of_squares = 0, largest = 0;
  int count = 0;
  for (int y = 0; y < mean.height; y += kBlock) {
    for (int x = 0; x < mean.width; x += kBlock) {
      for (int c = 0; c < 3; ++c) {
        const BlockComparison block = compare_block(result.picture, mean, error, x, y, c);
        if (block.standard_error <= block.rounding) {
          EXPECT_LE(std::fabs(block.difference), block.rounding + block.rare_events)
              << "block " << x << ", " << y << ", channel " << c;
          continue;
        }
        const double z = block.difference / block.standard_error;
        sum_of_squares += z * z;
        largest = std::max(largest, std::fabs(z));
        ++count;
      }
    }
  }
  EXPECT_LE(std::sqrt(sum_of_squares / count), 1.25);
  EXPECT_LE(largest, 6.5);
}

INSTANTIATE_TEST_SUITE_P(Pictures, Reference,
                         testing::Values("step3", "step5_depth4", "step6_depth8", "step7_depth16",
                                         "step8_depth16", "step10_1time-unit"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace sdlc::test
