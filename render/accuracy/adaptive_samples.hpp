#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/accuracy/error_estimate.hpp"
#include "render/film/film.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// Samples a pixel of the first of the two stages (Stein, "A two-sample test for a linear
/// hypothesis whose power is independent of the variance", 1945). They are kept, and so many that
/// their spread, pooled, and what they are kept for hardly depend on each other.
inline constexpr std::uint32_t kPilotSamples = 64;

/// How many samples each pixel gets in all so that the relative error of the picture comes down to
/// `error` with the fewest: whole replicates up to `most_samples`, at least `pilot_samples`, which
/// each has by now. With σ² the variance of a pixel, which falls as n^−b, that is n in proportion
/// to (σ²)^(1 / (1 + b)). The variance is, in the main, that of the pixels around it, and never its
/// own but for its part in the mean of all: how many samples a pixel gets then says nothing about
/// what they are, so that its mean and the estimate of its error stay unbiased. With its own the
/// error came out 2 % too small, and intervals of 95 % held 84 %.
std::vector<std::uint32_t> adaptive_samples(std::span<const PixelSpread> pilot,
                                            const ErrorEstimate& estimate, int width, double error,
                                            SamplerKind sampler, std::uint32_t pilot_samples,
                                            std::uint64_t most_samples);

}  // namespace sdlc::render
