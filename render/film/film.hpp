#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/film/first_hits.hpp"
#include "render/film/pixel_run.hpp"
#include "render/film/sample_sum.hpp"
#include "render/math/color.hpp"

namespace sdlc::render {

/// The minimum number of samples per pixel for replicates; pictures with fewer have one part and no
/// error estimate.
inline constexpr std::uint64_t kMinReplicatedSamples = 8;

/// How many samples of a pixel belong to each replicate.
using ReplicateCounts = std::array<std::uint32_t, kReplicates>;

/// A quarter of `samples` each, the remainder going to the first replicates.
constexpr ReplicateCounts split_in_replicates(std::uint64_t samples) noexcept {
  ReplicateCounts counts{};
  for (std::uint32_t i = 0; i < kReplicates; ++i) {
    counts[i] = static_cast<std::uint32_t>(samples / kReplicates + (i < samples % kReplicates));
  }
  return counts;
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

/// The samples that a film has room for.
struct FilmExtent {
  std::uint64_t first_pixel = 0;  ///< row by row from the top left of the picture
  std::size_t pixels = 0;         ///< consecutive ones
  /// Of each replicate of each pixel; a multiple of SampleSum::kBlock.
  std::uint32_t first_sample = 0;
  std::uint32_t replicates = kReplicates;  ///< 1 or kReplicates

  friend bool operator==(const FilmExtent&, const FilmExtent&) = default;
};

/// The smallest and the largest number of samples of a pixel.
struct SampleCounts {
  std::uint64_t min = 0, max = 0;
};

/// Whether a film has the sums of first hits, too.
enum class Channels : bool { Color, ColorAndFirstHits };

/// The exact sums of the samples of some pixels, by replicate. A film can be continued, in as many
/// steps as one likes, with the same bits as in one step. Different threads may work on different
/// pixels at the same time.
class Film {
 public:
  /// The bytes of a pixel that has `samples` samples.
  static std::size_t bytes_per_pixel(std::uint64_t samples,
                                     Channels channels = Channels::Color) noexcept;

  explicit Film(const FilmExtent& extent, Channels channels = Channels::Color);

  const FilmExtent& extent() const noexcept { return extent_; }
  std::size_t size() const noexcept { return extent_.pixels; }
  Channels channels() const noexcept { return channels_; }

  /// Makes room for pixels with these samples in their replicates, beside what each has. Not
  /// thread-safe.
  void reserve(std::span<const ReplicateCounts> counts);

  std::uint32_t count(std::size_t pixel, std::uint32_t replicate) const noexcept {
    return replicate < extent_.replicates ? counts_[slot(pixel, replicate)] : 0;
  }
  std::uint64_t samples(std::size_t pixel) const noexcept;
  /// Of all pixels.
  std::uint64_t samples() const noexcept;
  /// After the last sample of any replicate.
  std::uint32_t end_sample() const noexcept {
    return extent_.first_sample + (counts_.empty() ? 0 : std::ranges::max(counts_));
  }
  /// Precondition: there is a pixel.
  SampleCounts sample_counts() const noexcept;
  /// The sum of the samples of a replicate.
  SampleSum sum(std::size_t pixel, std::uint32_t replicate) const noexcept {
    return sum(slot(pixel, replicate));
  }
  /// Replaces the sum of a replicate, for which the film has room. `sum` begins at
  /// FilmExtent::first_sample.
  void set(std::size_t pixel, std::uint32_t replicate, const SampleSum& sum) noexcept;
  /// Precondition: the film has them.
  const FirstHitSums& first_hits(std::size_t pixel) const noexcept { return first_hits_[pixel]; }
  FirstHitSums& first_hits(std::size_t pixel) noexcept { return first_hits_[pixel]; }
  /// Black if there is no sample.
  LinearRgb mean(std::size_t pixel) const noexcept;
  /// Of one replicate. Precondition: it has a sample.
  LinearRgb mean(std::size_t pixel, std::uint32_t replicate) const noexcept {
    return sum(pixel, replicate).total() / static_cast<double>(count(pixel, replicate));
  }
  /// Precondition: each replicate has a sample.
  PixelSpread spread(std::size_t pixel) const noexcept;
  /// Per-channel estimates of the variance of the pixel's mean.
  LinearRgb variance(std::size_t pixel) const noexcept;

 private:
  friend class OpenPixels;

  struct Deleter {
    void operator()(LinearRgb* values) const noexcept;
  };
  using Values = std::unique_ptr<LinearRgb[], Deleter>;

  std::size_t slot(std::size_t pixel, std::uint32_t replicate) const noexcept {
    return pixel * extent_.replicates + replicate;
  }
  std::uint32_t end_of(std::size_t slot) const noexcept {
    return extent_.first_sample + counts_[slot];
  }
  std::span<LinearRgb> storage(std::size_t slot) const noexcept {
    return {values_.get() + slot * stride_, stride_};
  }
  SampleSum sum(std::size_t slot) const noexcept {
    return {storage(slot), extent_.first_sample, end_of(slot)};
  }
  std::array<LinearRgb, kReplicates> means(std::size_t pixel) const noexcept;

  FilmExtent extent_;
  Channels channels_;
  std::size_t stride_ = 0;                // values per sum
  std::vector<std::uint32_t> counts_;     // by slot
  Values values_;                         // by slot; undefined where there is no sample
  std::vector<FirstHitSums> first_hits_;  // by pixel
};

/// Some pixels of a film while they are traced. The film has their new samples only after close().
class OpenPixels {
 public:
  /// The pixels [begin, end) of the film, which has room for `target(pixel)` samples in each
  /// replicate of a pixel, and keeps a reference.
  template <typename TargetOf>
  OpenPixels(Film& film, std::size_t begin, std::size_t end, const TargetOf& target)
      : film_(film), begin_(begin) {
    targets_.reserve(end - begin);
    std::uint32_t largest = 0;
    for (std::size_t pixel = begin; pixel < end; ++pixel) {
      targets_.push_back(target(pixel));
      for (const std::uint32_t count : targets_.back()) largest = std::max(largest, count);
    }
    open(largest);
  }

  /// Appends the next runs: at most `max_blocks` for each pixel, nothing once all targets are
  /// reached.
  void plan(std::uint32_t max_blocks, std::vector<PixelRun>& runs);
  /// Adds a run after all runs of plan() are traced. Runs of a pixel come in the order of plan().
  void add(const PixelRun& run) noexcept;
  /// Moves the samples to the film. Returns false, and drops all new samples, if the film has no
  /// room for the sum of a pixel that stopped short of its target.
  bool close() noexcept;

 private:
  void open(std::uint32_t largest_target);
  SampleSum sum(std::size_t slot) const noexcept {
    return {{values_ + slot * stride_, stride_}, film_.extent_.first_sample, ends_[slot]};
  }

  Film& film_;
  std::size_t begin_;
  std::vector<ReplicateCounts> targets_;
  std::vector<LinearRgb> own_values_;  // empty if the film has room for all steps
  std::vector<std::uint32_t> ends_;
  LinearRgb* values_ = nullptr;
  std::size_t stride_ = 0;
  // By pixel; empty without first hits. Those of the last plan(), and those of the runs before.
  std::vector<FirstHitSums> planned_hits_, added_hits_;
};

}  // namespace sdlc::render
