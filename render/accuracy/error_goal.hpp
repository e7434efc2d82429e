#pragma once

#include <cstdint>
#include <optional>

#include "render/accuracy/error_estimate.hpp"

namespace sdlc::render {

/// What an error comes down to at best with so many times the samples, and how many times it takes,
/// usually, to bring it down to a part: it falls as a power of the samples, at best that of Sobol'
/// points on plain edges.
double least_error(double error, double more_samples) noexcept;
double usual_growth(double part) noexcept;

/// Decides after each pass over a picture how many samples come next until its error is known to be
/// small enough.
class ErrorGoal {
 public:
  /// `error`: what the upper end of the interval of the relative error has to come down to.
  ErrorGoal(double error, std::uint64_t most_samples)
      : error_(error), most_samples_(most_samples) {}

  /// What a goal takes at least: of fewer samples all replicates may miss the same highlight.
  std::uint64_t first_samples() const noexcept;

  /// The samples a pixel to be reached by the next pass, of those before and what they came to;
  /// nothing once the goal, or the most samples, is reached. A pass adds a quarter at most: fewer
  /// where by the slope of the error so far it is enough.
  std::optional<std::uint64_t> next_samples(std::uint64_t samples, const ErrorEstimate& estimate);

  bool is_reached() const noexcept { return is_reached_; }

 private:
  double error_;
  std::uint64_t most_samples_;
  bool is_reached_ = false;
  // The error falls as a power of the samples; until it is known, one between those of independent
  // samples and of the best that Sobol' points do.
  double slope_ = -0.6;
  std::uint64_t earlier_samples_ = 0;
  double earlier_error_ = 0;
};

}  // namespace sdlc::render
