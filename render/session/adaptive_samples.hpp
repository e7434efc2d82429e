#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/film/film.hpp"
#include "render/scene/scene.hpp"
#include "render/session/error_estimate.hpp"

namespace sdlc::render {

/// Samples per pixel in the first of the two stages (Stein, "A two-sample test for a linear
/// hypothesis whose power is independent of the variance", 1945). The pilot samples are kept. With
/// 64 of them, their pooled spread and the decision to keep them are nearly independent.
inline constexpr std::uint32_t kPilotSamples = 64;

/// Returns the samples per pixel, in total, that bring the relative error of the picture down to
/// `error` with the fewest samples: multiples of kReplicates, from `pilot_samples` (already taken)
/// to `max_samples`.
///
/// The variance σ² of a pixel falls as n^−b, so the optimal n is proportional to (σ²)^(1 / (1 +
/// b)). A pixel's σ² is estimated from the pixels around it, never from the pixel itself except
/// through the mean of all. The number of samples of a pixel is then independent of their values,
/// so its mean and error estimate stay unbiased. Using the pixel's own variance made the error 2 %
/// too small, and intervals of 95 % covered 84 %.
std::vector<std::uint32_t> adaptive_samples(std::span<const PixelSpread> pilot,
                                            const ErrorEstimate& estimate, int width, double error,
                                            SamplerKind sampler, std::uint32_t pilot_samples,
                                            std::uint64_t max_samples);

}  // namespace sdlc::render
