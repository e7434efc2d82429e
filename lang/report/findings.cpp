#include "lang/report/findings.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace sdlc::lang {
namespace {

bool passes(const FindingsFilter& filter, const Diagnostic& diagnostic) {
  const DiagnosticInfo& info = *diagnostic.info;
  if (filter.is_wanted && !filter.is_wanted(info, diagnostic.where.file)) return false;
  const bool is_warning = info.severity == Severity::Warning;
  return !is_warning || !filter.is_allowed || !filter.is_allowed(info, diagnostic.where);
}

void sort_by_place(std::vector<const Diagnostic*>& diagnostics) {
  std::unordered_map<const SourceFile*, std::size_t> ranks;
  for (const Diagnostic* diagnostic : diagnostics) {
    ranks.emplace(diagnostic->where.file, ranks.size());
  }
  std::ranges::stable_sort(diagnostics, {}, [&](const Diagnostic* diagnostic) {
    return std::pair(ranks.at(diagnostic->where.file), diagnostic->where.span.begin);
  });
}

}  // namespace

DiagnosticCounts& DiagnosticCounts::operator+=(const DiagnosticCounts& other) noexcept {
  errors += other.errors;
  warnings += other.warnings;
  omitted += other.omitted;
  return *this;
}

Findings select_findings(const DiagnosticSink& sink, const FindingsFilter& filter) {
  Findings findings;
  DiagnosticCounts& counts = findings.counts;
  const auto count_of = [&](const DiagnosticInfo& info) -> std::size_t& {
    return info.severity == Severity::Error ? counts.errors : counts.warnings;
  };
  std::vector<const Diagnostic*> wanted;
  for (const Diagnostic& diagnostic : sink.diagnostics()) {
    if (passes(filter, diagnostic)) wanted.push_back(&diagnostic);
  }
  sort_by_place(wanted);
  for (const Diagnostic* diagnostic : wanted) {
    if (++count_of(*diagnostic->info) <= filter.max_per_severity) {
      findings.shown.push_back(diagnostic);
    } else {
      ++counts.omitted;
    }
  }
  // Their places are unknown, so that comments that allow them have no effect.
  for (const auto& [info, count] : sink.not_kept()) {
    if (filter.is_wanted && !filter.is_wanted(*info, nullptr)) continue;
    count_of(*info) += count;
    counts.omitted += count;
  }
  return findings;
}

}  // namespace sdlc::lang
