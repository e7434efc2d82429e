#include "lang/repair/repair_report.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace sdlc::lang {

Location RepairRound::where(Span span) const {
  const Span place = context_.text.in_source(span);
  const auto size = static_cast<std::uint32_t>(context_.file.text().size());
  return {&context_.file, {std::min(place.begin, size), std::min(place.end, size)}};
}

DiagnosticBuilder RepairRound::report_expected(std::size_t token, std::string_view what,
                                               bool may_end_line) {
  const bool ends_line = may_end_line && token > 0 && tokens_[token].is_first;
  const std::string found =
      ends_line ? "the end of the line" : fmt::format("`{}`", tokens_.written(token));
  return report(diag::expected, ends_line ? gap_before(token) : span_of(token),
                fmt::format("{}, found {}", what, found));
}

}  // namespace sdlc::lang
