#include "render/film/film.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <type_traits>
#include <utility>

#include "render/math/table_memory.hpp"

namespace sdlc::render {
namespace {

double dot(LinearRgb a, LinearRgb b) noexcept { return a.r * b.r + a.g * b.g + a.b * b.b; }
double grey(LinearRgb c) noexcept { return (c.r + c.g + c.b) / 3; }

}  // namespace

std::size_t Film::bytes_per_pixel(std::uint64_t samples, Channels channels) noexcept {
  const std::size_t replicates = samples < kMinReplicatedSamples ? 1 : kReplicates;
  const std::uint64_t count = (samples + replicates - 1) / replicates;
  const std::size_t values = SampleSum::values_of(0, static_cast<std::uint32_t>(count));
  const std::size_t sums = replicates * (values * sizeof(LinearRgb) + sizeof(std::uint32_t));
  return sums + (channels == Channels::Color ? 0 : sizeof(FirstHitSums));
}

Film::Film(const FilmExtent& extent, Channels channels)
    : extent_(extent),
      channels_(channels),
      counts_(extent.pixels * extent.replicates),
      first_hits_(channels == Channels::Color ? 0 : extent.pixels) {}

void Film::Deleter::operator()(LinearRgb* values) const noexcept { free_table(values); }

void Film::reserve(std::span<const ReplicateCounts> counts) {
  const std::uint32_t first = extent_.first_sample;
  std::size_t stride = stride_;
  for (const ReplicateCounts& of_pixel : counts) {
    for (const std::uint32_t count : of_pixel) {
      stride = std::max(stride, SampleSum::values_of(first, first + count));
    }
  }
  if (stride == stride_) return;
  // Left undefined, so that the threads that fill the memory are the first to touch it.
  static_assert(std::is_trivially_copyable_v<LinearRgb>);
  Values values(
      static_cast<LinearRgb*>(allocate_table(counts_.size() * stride * sizeof(LinearRgb))));
  for (std::size_t slot = 0; slot < counts_.size(); ++slot) {
    if (counts_[slot] == 0) continue;
    std::copy_n(values_.get() + slot * stride_, stride_, values.get() + slot * stride);
  }
  values_ = std::move(values);
  stride_ = stride;
}

void Film::set(std::size_t pixel, std::uint32_t replicate, const SampleSum& sum) noexcept {
  const std::size_t slot = this->slot(pixel, replicate);
  counts_[slot] = sum.end() - extent_.first_sample;
  std::ranges::copy(sum.values(), storage(slot).begin());
}

std::uint64_t Film::samples(std::size_t pixel) const noexcept {
  std::uint64_t samples = 0;
  for (std::uint32_t i = 0; i < extent_.replicates; ++i) samples += count(pixel, i);
  return samples;
}

std::uint64_t Film::samples() const noexcept {
  return std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
}

SampleCounts Film::sample_counts() const noexcept {
  SampleCounts counts{.min = samples(0), .max = samples(0)};
  for (std::size_t pixel = 1; pixel < size(); ++pixel) {
    counts.min = std::min(counts.min, samples(pixel));
    counts.max = std::max(counts.max, samples(pixel));
  }
  return counts;
}

LinearRgb Film::mean(std::size_t pixel) const noexcept {
  const std::uint64_t count = samples(pixel);
  if (count == 0) return LinearRgb{};
  const auto total = [&](std::uint32_t i) { return sum(slot(pixel, i)).total(); };
  const LinearRgb sum =
      extent_.replicates == 1 ? total(0) : (total(0) + total(1)) + (total(2) + total(3));
  return sum / static_cast<double>(count);
}

std::array<LinearRgb, kReplicates> Film::means(std::size_t pixel) const noexcept {
  std::array<LinearRgb, kReplicates> means;
  for (std::uint32_t i = 0; i < kReplicates; ++i) {
    means[i] = mean(pixel, i);
  }
  return means;
}

LinearRgb Film::variance(std::size_t pixel) const noexcept {
  const std::array<LinearRgb, kReplicates> x = means(pixel);
  const LinearRgb mean = this->mean(pixel);
  LinearRgb squares;
  for (std::uint32_t i = 0; i < kReplicates; ++i) {
    const LinearRgb d = x[i] - mean;
    squares += d * d * count(pixel, i);
  }
  return squares / ((kReplicates - 1) * static_cast<double>(samples(pixel)));
}

PixelSpread Film::spread(std::size_t pixel) const noexcept {
  const std::array<LinearRgb, kReplicates> x = means(pixel);
  const LinearRgb mean = this->mean(pixel);
  PixelSpread spread;
  for (std::uint32_t i = 0; i < kReplicates; ++i) {
    const LinearRgb d = x[i] - mean;
    const double weight = count(pixel, i);
    spread.squared_error += weight * dot(d, d);
    spread.grey_variance += weight * grey(d) * grey(d);
  }
  const double share = 1 / ((kReplicates - 1) * static_cast<double>(samples(pixel)));
  spread.squared_error *= share;
  spread.grey_variance *= share;
  // Unbiased for tr Σ² if the means are normal, for any covariance. With the sample covariance S of
  // R means and ν = R − 1 = 3: E tr S² = tr Σ² + (tr Σ² + (tr Σ)²) / ν and E (tr S)² = (tr Σ)² + 2
  // tr Σ² / ν. For rare bright samples it is too large, by 0.15 times the excess kurtosis of the
  // means. Computed in units of the largest square, because fourth powers overflow or underflow
  // long before squares do.
  double unit = 0;
  for (const LinearRgb& value : x) unit = std::max(unit, dot(value - mean, value - mean));
  if (!(unit > 0)) return spread;
  double trace = 0, trace_of_square = 0;
  for (std::size_t i = 0; i < kReplicates; ++i) {
    for (std::size_t j = 0; j < kReplicates; ++j) {
      const double product = dot(x[i] - mean, x[j] - mean) / unit;
      trace_of_square += product * product;
      if (i == j) trace += product;
    }
  }
  constexpr double kDegrees = kReplicates - 1;
  const double squared = 0.9 * (trace_of_square - trace * trace / kDegrees);
  spread.covariance = std::sqrt(std::max(squared, 0.0)) / kDegrees * unit;
  return spread;
}

void OpenPixels::open(std::uint32_t largest_target) {
  const std::size_t first = begin_ * film_.extent_.replicates;
  const std::size_t slots = targets_.size() * film_.extent_.replicates;
  ends_.resize(slots);
  for (std::size_t i = 0; i < slots; ++i) ends_[i] = film_.end_of(first + i);
  if (film_.channels() != Channels::Color) {
    planned_hits_.resize(targets_.size());
    added_hits_.resize(targets_.size());
  }
  const std::uint32_t first_sample = film_.extent_.first_sample;
  stride_ = largest_target <= SampleSum::kBlock
                ? 1
                : SampleSum::max_values_of(first_sample, first_sample + largest_target);
  if (stride_ <= film_.stride_) {
    stride_ = film_.stride_;
    values_ = film_.values_.get() + first * stride_;
    return;
  }
  own_values_.resize(slots * stride_);
  values_ = own_values_.data();
  for (std::size_t i = 0; i < slots; ++i) {
    if (film_.counts_[first + i] == 0) continue;
    std::ranges::copy(film_.storage(first + i),
                      own_values_.begin() + static_cast<std::ptrdiff_t>(i * stride_));
  }
}

void OpenPixels::plan(std::uint32_t max_blocks, std::vector<PixelRun>& runs) {
  std::ranges::fill(planned_hits_, FirstHitSums{});
  const std::uint32_t replicates = film_.extent_.replicates, first = film_.extent_.first_sample;
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const std::size_t slot = i * replicates;
    std::array<std::uint32_t, kReplicates> next{}, target{};
    bool is_done = true;
    for (std::uint32_t r = 0; r < replicates; ++r) {
      next[r] = ends_[slot + r];
      target[r] = first + targets_[i][r];
      is_done = is_done && next[r] >= target[r];
    }
    for (std::uint32_t block = 0; block < max_blocks && !is_done; ++block) {
      // In place: a run is large to copy.
      PixelRun& run = runs.emplace_back();
      run.pixel = film_.extent_.first_pixel + begin_ + i;
      if (!planned_hits_.empty()) run.first_hits = &planned_hits_[i];
      is_done = true;
      for (std::uint32_t r = 0; r < replicates; ++r) {
        if (next[r] >= target[r]) continue;
        PixelRun::Part& part = run.parts[r];
        part.first = next[r];
        if (next[r] % SampleSum::kBlock != 0) part.sum = sum(slot + r).open_block();
        const std::uint32_t end = (next[r] / SampleSum::kBlock + 1) * SampleSum::kBlock;
        next[r] = std::min(target[r], end);
        part.count = next[r] - part.first;
        is_done = is_done && next[r] == target[r];
      }
    }
  }
}

void OpenPixels::add(const PixelRun& run) noexcept {
  const auto pixel = static_cast<std::size_t>(run.pixel - film_.extent_.first_pixel) - begin_;
  for (std::uint32_t r = 0; r < film_.extent_.replicates; ++r) {
    if (run.parts[r].count == 0) continue;
    const std::size_t slot = pixel * film_.extent_.replicates + r;
    SampleSum sum = this->sum(slot);
    sum.extend(run.parts[r].sum, run.parts[r].count);
    ends_[slot] = sum.end();
  }
  if (run.first_hits == nullptr) return;
  added_hits_[pixel] += *run.first_hits;
  *run.first_hits = {};  // other runs of the pixel have the same
}

bool OpenPixels::close() noexcept {
  const std::uint32_t first_sample = film_.extent_.first_sample;
  const bool has_room = std::ranges::all_of(ends_, [&](std::uint32_t end) {
    return SampleSum::values_of(first_sample, end) <= film_.stride_;
  });
  if (!has_room) return false;
  const std::size_t first = begin_ * film_.extent_.replicates;
  for (std::size_t i = 0; i < ends_.size(); ++i) {
    if (!own_values_.empty()) std::ranges::copy(sum(i).values(), film_.storage(first + i).begin());
    film_.counts_[first + i] = ends_[i] - first_sample;
  }
  for (std::size_t i = 0; i < added_hits_.size(); ++i)
    film_.first_hits_[begin_ + i] += added_hits_[i];
  return true;
}

}  // namespace sdlc::render
