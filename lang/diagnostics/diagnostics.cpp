#include "lang/diagnostics/diagnostics.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <iterator>

namespace sdlc::lang {

std::span<const DiagnosticInfo* const> all_diagnostics() noexcept {
  static constexpr auto kAll = std::to_array<const DiagnosticInfo*>({
#define SDLC_DIAGNOSTIC(code, severity, name, message, ...) &diag::name,
#include "lang/diagnostics/diagnostics.def"
#undef SDLC_DIAGNOSTIC
  });
  return kAll;
}

DiagnosticBuilder& DiagnosticBuilder::label(Location where, std::string message) {
  diagnostic_->labels.push_back({where, std::move(message)});
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::help(std::string text) {
  diagnostic_->help.push_back(std::move(text));
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::fix(Location where, std::string replacement) {
  diagnostic_->fixes.push_back({where, std::move(replacement), true});
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::unsafe_fix(Location where, std::string replacement) {
  diagnostic_->fixes.push_back({where, std::move(replacement), false});
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::chain(std::vector<ChainLink> links) {
  diagnostic_->chain = std::move(links);
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::suggest(std::optional<std::string_view> name) {
  if (!name) return *this;
  diagnostic_->suggestion = *name;
  return unsafe_fix(diagnostic_->where, std::string(*name));
}

DiagnosticCounts& DiagnosticCounts::operator+=(const DiagnosticCounts& other) noexcept {
  errors += other.errors;
  warnings += other.warnings;
  omitted += other.omitted;
  return *this;
}

DiagnosticBuilder DiagnosticSink::discard() {
  discarded_ = {};
  return DiagnosticBuilder(discarded_, false);
}

DiagnosticBuilder DiagnosticSink::add(const DiagnosticInfo& info, Location where,
                                      std::string message) {
  if (is_muted_) return discard();
  const bool is_error = info.severity == Severity::Error;
  if (!is_error && is_allowed_ && is_allowed_(info, where)) return discard();
  const std::string place =
      fmt::format("{} {} {} {} ", info.code, static_cast<const void*>(where.file), where.span.begin,
                  where.span.end);
  const std::hash<std::string_view> hash;
  // Past this many, duplicates are no longer detected.
  constexpr std::size_t kMaxDistinct = 1'000'000;
  if (told_.size() < kMaxDistinct && !told_.insert(hash(place) * 31 + hash(message)).second) {
    return discard();
  }
  if (is_wanted_ && !is_wanted_(info)) {
    if (is_error) ++unwanted_errors_;
    return discard();
  }
  if (++(is_error ? counts_.errors : counts_.warnings) > max_per_severity_) {
    ++counts_.omitted;
    return discard();
  }
  diagnostics_.push_back({.info = &info,
                          .where = where,
                          .message = std::move(message),
                          .labels = {},
                          .help = {},
                          .fixes = {},
                          .suggestion = {},
                          .chain = chain()});
  return DiagnosticBuilder(diagnostics_.back());
}

void DiagnosticSink::forget_shown() {
  diagnostics_.clear();
  counts_ = {};
  unwanted_errors_ = 0;
}

std::vector<const Diagnostic*> DiagnosticSink::sorted() const {
  std::vector<const SourceFile*> files;
  std::vector<const Diagnostic*> sorted;
  for (const Diagnostic& diagnostic : diagnostics_) {
    sorted.push_back(&diagnostic);
    if (std::find(files.begin(), files.end(), diagnostic.where.file) == files.end()) {
      files.push_back(diagnostic.where.file);
    }
  }
  const auto key = [&](const Diagnostic* diagnostic) {
    const auto file = std::find(files.begin(), files.end(), diagnostic->where.file);
    return std::pair(std::distance(files.begin(), file), diagnostic->where.span.begin);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Diagnostic* a, const Diagnostic* b) { return key(a) < key(b); });
  return sorted;
}

}  // namespace sdlc::lang
