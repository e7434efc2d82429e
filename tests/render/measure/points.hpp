#pragma once

#include "render/measure/measurement.hpp"

namespace sdlc::test {

inline render::Measured measured(double value, double share) {
  return {value, {value * (1 - share), value * (1 + share)}};
}

/// A point whose intervals are ±2 %.
inline render::Point point(int samples, double seconds, double error,
                           render::Configuration configuration = {}) {
  return {.configuration = configuration,
          .samples = samples,
          .timings = {seconds},
          .error = measured(error, 0.02),
          .seconds = measured(seconds, 0.02)};
}

inline const render::Configuration kIndependent{.sampler = render::SamplerKind::Independent};

}  // namespace sdlc::test
