#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "lang/compile/compile.hpp"
#include "render/session/render.hpp"
#include "tests/render/kernel/kernels.hpp"

// Compares pictures with those of an independent renderer, which include the standard error of
// every pixel. They are not part of the repository; without them the tests are skipped.
namespace sdlc::test {
namespace {

namespace fs = std::filesystem;

const fs::path kReferences = fs::path(SDLC_SOURCE_DIR) / ".." / "shared" / "reference";
constexpr int kReferenceSamples = 4096;
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
  /// If the reference saw almost no noise in 4096 samples per pixel, its standard error is
  /// unreliable: of paths with radiance 1 that are unlike the others it saw none, or at most 10.
  /// The probability that more than 5, or 8, of them are then found here, by 256 samples per pixel,
  /// is 7e-9, or 9e-8, at the mean that makes it most likely; less with fewer samples. 0 if our
  /// block is flat.
  double rare_events = 0;
};

BlockComparison compare_block(const render::Picture& ours, const Pfm& mean, const Pfm& error,
                              int samples, int x0, int y0, int c) {
  BlockComparison block;
  double variance = 0, reference_variance = 0;
  bool is_flat = true;
  for (int y = y0; y < std::min(y0 + kBlock, mean.height); ++y) {
    for (int x = x0; x < std::min(x0 + kBlock, mean.width); ++x) {
      const double value = channel(ours.at(x, y), c);
      block.difference += value - mean.at(x, y, c);
      block.rounding += 0x1p-24 * value;
      const double sem = error.at(x, y, c);
      reference_variance += sem * sem;
      variance += sem * sem * (1 + static_cast<double>(kReferenceSamples) / samples);
      if (value != channel(ours.at(x0, y0), c)) is_flat = false;
    }
  }
  block.standard_error = std::sqrt(variance);
  const double events = reference_variance * kReferenceSamples * kReferenceSamples;
  if (!is_flat && events <= 10) {
    block.rare_events = (block.standard_error > block.rounding ? 8.0 : 5.0) / samples;
  }
  return block;
}

/// A configuration to trace the pictures with.
struct Form {
  std::string name;
  render::KernelRequest request;
  int samples = 0;
};

/// The automatic choice, and with fewer samples everything else that this machine supports. All
/// trace the same paths, which tests/render/kernel compares one by one; here each is tested
/// independently.
std::vector<Form> forms() {
  std::vector<Form> all{{"chosen", {}, 256},
                        {"scalar", {.backend = &render::portable_backend()}, 64}};
  for (const WideForm& wide : wide_forms()) {
    all.push_back({std::string(wide.backend->name) + "_" + std::string(name_of(wide.precision)),
                   wide.request(), 64});
    render::KernelRequest by_hierarchy = wide.request();
    by_hierarchy.search = render::Search::Bvh;
    all.push_back({"bvh_" + all.back().name, by_hierarchy, 64});
  }
  return all;
}

class Reference : public testing::TestWithParam<std::tuple<std::string, Form>> {
 protected:
  void SetUp() override {
    config_ = kReferences / "configs" / (picture() + ".json");
    if (!fs::exists(config_)) GTEST_SKIP() << "the reference pictures are not here";
    mean_ = read_pfm(kReferences / (picture() + ".mean.pfm"));
    error_ = read_pfm(kReferences / (picture() + ".sem.pfm"));
  }

  static const std::string& picture() { return std::get<std::string>(GetParam()); }
  static const Form& form() { return std::get<Form>(GetParam()); }

  /// The configuration as a scene for a picture of the reference's size.
  std::optional<lang::LoweredScene> read_scene() const {
    std::ifstream stream(config_);
    const lang::Document source(config_.string(),
                                std::string(std::istreambuf_iterator<char>(stream), {}));
    lang::DiagnosticSink sink;
    using namespace lang::render_property;
    const double width = mean_.width, samples = form().samples;
    return lang::compile(source, {.render = {{kWidth, width}, {kSamples, samples}}}, sink);
  }

  fs::path config_;
  Pfm mean_, error_;
};

// H0: both pictures estimate the same radiance. Block means of 8 × 8 pixels are divided by their
// standard error, that of the reference and, from it, that of our samples. Under H0 the mean square
// of the 559 to 1125 values is near 1 (its standard deviation .03 if they were normal; the bound of
// 1.25² leaves room for what small samples of skewed radiance do), no |z| passes 6.5 (p = 8e-11
// each), and the |z| of a channel's sum not 5 (p = 6e-7 each): it would at a shift of 0.02 % in the
// quietest picture and of 0.6 % in the noisiest.
TEST_P(Reference, AgreesInBlockMeans) {
  const std::optional<lang::LoweredScene> lowered = read_scene();
  ASSERT_TRUE(lowered);
  ASSERT_EQ(lowered->settings.height, mean_.height);
  const bool wants_float = form().request.precision == render::Precision::Float;
  if (wants_float &&
      choose_kernel(lowered->scene, lowered->settings).precision == render::Precision::Double) {
    GTEST_SKIP() << "the scene asks for double";
  }
  const render::RenderResult result =
      render_with(lowered->scene, lowered->settings, form().request);
  EXPECT_FALSE(result.kernel.refusal);
  EXPECT_EQ(result.nonfinite_samples, 0u);

  double sum_of_squares = 0, largest = 0;
  int count = 0;
  for (int c = 0; c < 3; ++c) {
    double difference = 0, variance = 0, rounding = 0;
    for (int y = 0; y < mean_.height; y += kBlock) {
      for (int x = 0; x < mean_.width; x += kBlock) {
        const BlockComparison block =
            compare_block(result.picture, mean_, error_, form().samples, x, y, c);
        if (block.standard_error <= block.rounding) {
          EXPECT_LE(std::fabs(block.difference), block.rounding + block.rare_events)
              << "block " << x << ", " << y << ", channel " << c;
          continue;
        }
        const double z = block.difference / block.standard_error;
        sum_of_squares += z * z;
        if (std::fabs(block.difference) > block.rare_events) {
          largest = std::max(largest, std::fabs(z));
        }
        ++count;
        difference += block.difference;
        variance += block.standard_error * block.standard_error;
        rounding += block.rounding;
      }
    }
    EXPECT_LE(std::fabs(difference), 5 * std::sqrt(variance) + rounding) << "channel " << c;
  }
  EXPECT_LE(std::sqrt(sum_of_squares / count), 1.25);
  EXPECT_LE(largest, 6.5);
}

INSTANTIATE_TEST_SUITE_P(Pictures, Reference,
                         testing::Combine(testing::Values("step3", "step5_depth4", "step6_depth8",
                                                          "step7_depth16", "step8_depth16",
                                                          "step10_1time-unit"),
                                          testing::ValuesIn(forms())),
                         [](const auto& test) {
                           std::string name =
                               std::get<0>(test.param) + "_" + std::get<1>(test.param).name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

}  // namespace
}  // namespace sdlc::test
