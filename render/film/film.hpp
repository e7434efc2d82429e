#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/film/sample_run.hpp"
#include "render/film/sample_sum.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// The number of replicates of a picture: its samples are split into this many parts that are
/// scrambled independently. The differences between the parts give an estimate of the error.
inline constexpr std::uint32_t kReplicates = 4;
/// The minimum number of samples per pixel for replicates; pictures with fewer have one part and no
/// error estimate.
inline constexpr std::uint64_t kMinReplicatedSamples = 8;

/// How many of `samples` samples per pixel belong to replicate `index`: a quarter each, the
/// remainder going to the first replicates.
constexpr std::uint32_t samples_in_replicate(std::uint64_t samples, std::uint32_t index) noexcept {
  return static_cast<std::uint32_t>(samples / kReplicates + (index < samples % kReplicates));
}

/// How much the replicates of one pixel differ. See ErrorEstimate.
struct PixelSpread {
  /// Estimate of the squared error of the pixel's mean, summed over channels.
  double squared_error = 0;
  /// Root of an estimate of tr Σ², where Σ is the covariance matrix of the mean of one replicate.
  /// Its square is unbiased for normal means, and too large for means with heavier tails.
  double covariance = 0;
  /// Estimate of the variance of the grey value (the mean of the channels) of the pixel's mean.
  double grey_variance = 0;
};

/// The sums of the samples of a range of consecutive pixels. Different threads may work on
/// different pixels at the same time.
class Film {
 public:
  /// Valid up to 64 samples per replicate; each further factor of 2 adds 96 bytes.
  static constexpr std::size_t kBytesPerPixel =
      kReplicates * (2 * sizeof(LinearRgb) + sizeof(std::uint32_t));

  /// Covers `pixels` pixels from index `first`, row by row from the top left of the picture.
  Film(std::uint64_t first, std::size_t pixels);

  std::size_t size() const noexcept { return counts_.size() / kReplicates; }

  /// Reserves memory for this many samples in each replicate. Not thread-safe.
  void reserve(std::uint32_t samples_per_replicate);

  /// Appends the next runs towards `target` samples per replicate: at most `max_blocks` blocks,
  /// nothing once the target is reached.
  using Target = std::array<std::uint32_t, kReplicates>;
  void plan(std::size_t pixel, const Target& target, std::uint32_t max_blocks,
            std::vector<SampleRun>& runs) const;
  /// Adds a run after it is traced. Runs of one replicate must come in order.
  void add(const SampleRun& run) noexcept;

  std::uint64_t samples(std::size_t pixel) const noexcept;
  /// Black if there is no sample.
  LinearRgb mean(std::size_t pixel) const noexcept;
  /// Precondition: each replicate has a sample.
  PixelSpread spread(std::size_t pixel) const noexcept;
  /// Per-channel estimates of the variance of the pixel's mean.
  LinearRgb variance(std::size_t pixel) const noexcept;

 private:
  std::span<LinearRgb> storage(std::size_t slot) noexcept {
    return std::span(values_).subspan(slot * stride_, stride_);
  }
  SampleSum sum(std::size_t slot) const noexcept {
    return {const_cast<Film&>(*this).storage(slot), counts_[slot]};
  }
  std::array<LinearRgb, kReplicates> means(std::size_t pixel) const noexcept;

  std::uint64_t first_;
  std::size_t stride_ = 1;             // values per sum
  std::vector<std::uint32_t> counts_;  // number of samples, per replicate of each pixel
  std::vector<LinearRgb> values_;
};

}  // namespace sdlc::render
