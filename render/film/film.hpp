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

/// The replicates of a picture: its samples are in so many parts that are scrambled independently
/// of each other, and what the parts differ by says how large its error is.
inline constexpr std::uint32_t kReplicates = 4;
/// From so many samples a pixel on there are replicates; fewer are one part, without an error.
inline constexpr std::uint64_t kLeastReplicatedSamples = 8;

/// Of `samples` a pixel those in the replicate `index`: a quarter each, the first ones one more.
constexpr std::uint32_t samples_in_replicate(std::uint64_t samples, std::uint32_t index) noexcept {
  return static_cast<std::uint32_t>(samples / kReplicates + (index < samples % kReplicates));
}

/// What the replicates of one pixel differ by. See ErrorEstimate.
struct PixelSpread {
  /// Estimate of the squared error of the pixel's mean, summed over the channels.
  double squared_error = 0;
  /// Root of an estimate of tr Σ², with the covariance matrix Σ of the mean of one replicate; its
  /// square is unbiased for normal means, and too large for means with heavier tails.
  double covariance = 0;
  /// Estimate of the variance of the mean of the channels of the pixel's mean.
  double grey_variance = 0;
};

/// The sums of the samples of some consecutive pixels. Different pixels may be worked on by
/// different threads at a time.
class Film {
 public:
  /// Up to 64 samples a replicate; later 96 more for each factor of 2.
  static constexpr std::size_t kBytesAPixel =
      kReplicates * (2 * sizeof(LinearRgb) + sizeof(std::uint32_t));

  /// Of `pixels` pixels from `first` on, counted row by row from the top left of the picture.
  Film(std::uint64_t first, std::size_t pixels);

  std::size_t size() const noexcept { return counts_.size() / kReplicates; }

  /// Makes room for so many samples in each replicate; not while others use the film.
  void reserve(std::uint32_t samples_a_replicate);

  /// The runs that come next on the way to `target` samples of each replicate: up to `most_blocks`
  /// blocks. Appends nothing when it is there.
  using Target = std::array<std::uint32_t, kReplicates>;
  void plan(std::size_t pixel, const Target& target, std::uint32_t most_blocks,
            std::vector<SampleRun>& runs) const;
  /// Takes over a run once it is traced; those of a replicate in their order.
  void add(const SampleRun& run) noexcept;

  std::uint64_t samples(std::size_t pixel) const noexcept;
  /// Black where there is no sample.
  LinearRgb mean(std::size_t pixel) const noexcept;
  /// Precondition: each replicate has a sample.
  PixelSpread spread(std::size_t pixel) const noexcept;
  /// The same for each channel: estimates of the variance of the pixel's mean.
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
  std::size_t stride_ = 1;             // numbers a sum
  std::vector<std::uint32_t> counts_;  // samples of each replicate of each pixel
  std::vector<LinearRgb> values_;
};

}  // namespace sdlc::render
