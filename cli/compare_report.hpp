#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "cli/compare_pair.hpp"
#include "render/compare/difference.hpp"
#include "render/compare/flip.hpp"
#include "render/compare/z_test.hpp"

namespace sdlc::cli {

/// A condition on a measure: at most the limit, or for the PSNR at least the limit.
struct Gate {
  std::string name;      ///< of the flag: "max-rmse"
  std::string quantity;  ///< in words: "the RMSE"
  double limit = 0;
  double value = 0;
  bool is_minimum = false;  ///< the limit is a minimum, not a maximum

  bool passes() const noexcept { return is_minimum ? value >= limit : value <= limit; }
};

/// The picture written by -o.
struct DifferencePicture {
  std::string path;
  std::string what;           ///< "difference" or "flip"
  std::optional<double> top;  ///< value of the brightest colour; nullopt without colours
};

/// The complete result of `sdlc compare`.
struct CompareReport {
  ComparedPair pair;
  render::Difference difference;
  render::FlipMap flip;
  double pixels_per_degree = render::kFlipPixelsPerDegree;
  std::optional<render::ZTest> z_test;
  std::vector<Gate> gates;
  std::optional<DifferencePicture> output;

  /// "red", or "grey" for pictures without colours.
  std::string_view channel_name() const noexcept;
};

std::string to_text(const CompareReport& report);
/// One line of `name=value` pairs.
std::string to_concise_text(const CompareReport& report);
std::string to_json(const CompareReport& report);

}  // namespace sdlc::cli
