#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "cli/report/report.hpp"

/// The parts of the page, as HTML. A part without content is empty.
namespace sdlc::cli {

/// What a reader has to know first: warnings, missing points, a different size.
std::string callouts(const Report& report);

std::string recommendation_section(const Report& report);
std::string error_charts_section(const Report& report);
std::string depth_section(const Report& report);
std::string precision_section(const Report& report);
std::string points_section(const Report& report);
std::string pictures_section(const Report& report);
std::string against_section(const Report& report);
std::string method_section(const Report& report);

/// "on the front".
std::string_view words_of(render::Dominance dominance);

/// The letter of a series in charts and tables: A to Z, then A1.
std::string series_key(std::size_t index);

/// A highlighted sentence; `text` is plain text.
std::string callout(std::string_view text);

/// The picture as an element with embedded data; empty without a picture.
std::string picture_element(const ReportImage& image);

}  // namespace sdlc::cli
