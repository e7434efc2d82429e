#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "cli/report/report.hpp"
#include "cli/report/table.hpp"

namespace sdlc::cli {

/// A part of a report: on the page, and in the terminal unless it is for the page only.
class Section {
 public:
  /// A paragraph of HTML.
  void paragraph(std::string_view html, std::string_view css_class = {});
  /// A highlighted sentence of plain text.
  void callout(std::string_view sentence);
  void table(const Table& table);
  void page_only(std::string_view html) { html_ += html; }

  const std::string& html() const noexcept { return html_; }
  const std::string& text() const noexcept { return text_; }

 private:
  std::string html_, text_;
};

/// The notes of the report.
Section callouts(const Report& report);

Section recommendation_section(const Report& report);
Section error_charts_section(const Report& report);
Section depth_section(const Report& report);
Section precision_section(const Report& report);
Section threads_section(const Report& report);
Section points_section(const Report& report);
Section pictures_section(const Report& report);
Section against_section(const Report& report);
Section method_section(const Report& report);

/// "512 samples, sobol, …; its own error is 0.1 %, …".
std::string describe_reference(const render::Reference& reference);

/// "on the front".
std::string_view words_of(render::Dominance dominance);

/// The letter of a series in charts and tables.
std::string series_letter(std::size_t index);
/// The letter in the colour of the series, as HTML.
std::string series_key(std::size_t index);

/// The picture as an element with embedded data; empty without a picture.
std::string picture_element(const ReportImage& image);

}  // namespace sdlc::cli
