#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

/// Number of diagnostics that a filter lets pass.
struct DiagnosticCounts {
  std::size_t errors = 0, warnings = 0;  ///< including those not shown
  std::size_t omitted = 0;               ///< of both, those not shown

  friend bool operator==(const DiagnosticCounts&, const DiagnosticCounts&) = default;
  DiagnosticCounts& operator+=(const DiagnosticCounts& other) noexcept;
};

/// Which diagnostics of a sink are shown. An empty function lets everything pass.
struct FindingsFilter {
  /// Errors that are shown, and as many warnings. Fixing the first 50 and running again helps more
  /// than reading about the 51st.
  static constexpr std::size_t kMaxShown = 50;

  /// By code and file; the file is null for a diagnostic without a place.
  std::function<bool(const DiagnosticInfo&, const SourceFile*)> is_wanted = {};
  /// Warnings that a comment of the text allows.
  std::function<bool(const DiagnosticInfo&, Location)> is_allowed = {};
  std::size_t max_per_severity = kMaxShown;
};

/// The diagnostics of a sink that are shown. They point into the sink.
struct Findings {
  /// By place: files in the order in which they were first mentioned, then offsets.
  std::vector<const Diagnostic*> shown;
  DiagnosticCounts counts;
};

Findings select_findings(const DiagnosticSink& sink, const FindingsFilter& filter = {});

}  // namespace sdlc::lang
