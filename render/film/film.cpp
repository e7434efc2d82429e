#include "render/film/film.hpp"

#include <algorithm>
#include <cmath>

namespace sdlc::render {
namespace {

double dot(LinearRgb a, LinearRgb b) noexcept { return a.r * b.r + a.g * b.g + a.b * b.b; }
double grey(LinearRgb c) noexcept { return (c.r + c.g + c.b) / 3; }

}  // namespace

Film::Film(std::uint64_t first, std::size_t pixels)
    : first_(first), counts_(pixels * kReplicates), values_(pixels * kReplicates) {}

void Film::reserve(std::uint32_t samples_per_replicate) {
  const std::size_t stride = SampleSum::storage_for(samples_per_replicate);
  if (stride <= stride_) return;
  std::vector<LinearRgb> values(counts_.size() * stride);
  for (std::size_t slot = 0; slot < counts_.size(); ++slot) {
    std::copy_n(values_.begin() + static_cast<std::ptrdiff_t>(slot * stride_), stride_,
                values.begin() + static_cast<std::ptrdiff_t>(slot * stride));
  }
  values_ = std::move(values);
  stride_ = stride;
}

void Film::plan(std::size_t pixel, const Target& target, std::uint32_t max_blocks,
                std::vector<SampleRun>& runs) const {
  for (std::uint32_t replicate = 0; replicate < kReplicates; ++replicate) {
    const std::size_t slot = pixel * kReplicates + replicate;
    std::uint32_t next = counts_[slot];
    SampleRun run{.pixel = first_ + pixel, .replicate = replicate, .sum = sum(slot).open_block()};
    for (std::uint32_t i = 0; i < max_blocks && next < target[replicate]; ++i) {
      const std::uint32_t end = (next / SampleSum::kBlock + 1) * SampleSum::kBlock;
      run.first = next;
      run.count = std::min(end, target[replicate]) - next;
      runs.push_back(run);
      next += run.count;
      run.sum = LinearRgb{};
    }
  }
}

void Film::add(const SampleRun& run) noexcept {
  const std::size_t slot = static_cast<std::size_t>(run.pixel - first_) * kReplicates +
                           static_cast<std::size_t>(run.replicate);
  SampleSum sum(storage(slot), counts_[slot]);
  sum.extend(run.sum, run.count);
  counts_[slot] = static_cast<std::uint32_t>(sum.count());
}

std::uint64_t Film::samples(std::size_t pixel) const noexcept {
  std::uint64_t samples = 0;
  for (std::size_t i = 0; i < kReplicates; ++i) samples += counts_[pixel * kReplicates + i];
  return samples;
}

LinearRgb Film::mean(std::size_t pixel) const noexcept {
  const std::uint64_t count = samples(pixel);
  if (count == 0) return LinearRgb{};
  const auto total = [&](std::size_t i) { return sum(pixel * kReplicates + i).total(); };
  return ((total(0) + total(1)) + (total(2) + total(3))) / static_cast<double>(count);
}

std::array<LinearRgb, kReplicates> Film::means(std::size_t pixel) const noexcept {
  std::array<LinearRgb, kReplicates> means;
  for (std::size_t i = 0; i < kReplicates; ++i) {
    const std::size_t slot = pixel * kReplicates + i;
    means[i] = sum(slot).total() / static_cast<double>(counts_[slot]);
  }
  return means;
}

LinearRgb Film::variance(std::size_t pixel) const noexcept {
  const std::array<LinearRgb, kReplicates> x = means(pixel);
  const LinearRgb mean = this->mean(pixel);
  LinearRgb squares;
  for (std::size_t i = 0; i < kReplicates; ++i) {
    const LinearRgb d = x[i] - mean;
    squares += d * d * counts_[pixel * kReplicates + i];
  }
  return squares / ((kReplicates - 1) * static_cast<double>(samples(pixel)));
}

PixelSpread Film::spread(std::size_t pixel) const noexcept {
  const std::array<LinearRgb, kReplicates> x = means(pixel);
  const LinearRgb mean = this->mean(pixel);
  PixelSpread spread;
  for (std::size_t i = 0; i < kReplicates; ++i) {
    const LinearRgb d = x[i] - mean;
    const double weight = counts_[pixel * kReplicates + i];
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

}  // namespace sdlc::render
