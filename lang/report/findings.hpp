#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// The number of diagnostics that pass a filter.
struct DiagnosticCounts {
  std::size_t errors = 0, warnings = 0;  ///< including those not shown
  std::size_t omitted = 0;               ///< errors and warnings not shown

  friend bool operator==(const DiagnosticCounts&, const DiagnosticCounts&) = default;
  DiagnosticCounts& operator+=(const DiagnosticCounts& other) noexcept;
};

/// Selects the diagnostics to show. An empty function accepts everything.
struct FindingsFilter {
  /// Max errors shown, and as many warnings. Fixing the first 50 and checking again helps more than
  /// reading the 51st.
  static constexpr std::size_t kMaxShown = 50;

  /// By code and file; the file is null for a diagnostic without a place.
  std::function<bool(const DiagnosticInfo&, const SourceFile*)> is_wanted = {};
  /// Whether a comment of the text allows the warning.
  std::function<bool(const DiagnosticInfo&, Location)> is_allowed = {};
  std::size_t max_per_severity = kMaxShown;
};

/// The diagnostics to show; they point into the sink.
struct Findings {
  /// By place: files in the order in which they first occur, then offsets.
  std::vector<const Diagnostic*> shown;
  DiagnosticCounts counts;
};

Findings select_findings(const DiagnosticSink& sink, const FindingsFilter& filter = {});

}  // namespace sdlc::lang
