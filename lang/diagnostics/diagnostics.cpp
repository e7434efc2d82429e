#include "lang/diagnostics/diagnostics.hpp"

#include <algorithm>
#include <array>
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
  diagnostic_->fixes.push_back({where, std::move(replacement)});
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::chain(std::vector<ChainLink> links) {
  diagnostic_->chain = std::move(links);
  return *this;
}

DiagnosticBuilder& DiagnosticBuilder::suggest(std::optional<std::string_view> name) {
  if (!name) return *this;
  diagnostic_->suggestion = *name;
  return fix(diagnostic_->where, std::string(*name));
}

DiagnosticBuilder DiagnosticSink::add(const DiagnosticInfo& info, Location where,
                                      std::string message) {
  if (is_muted_) {
    discarded_ = {};
    return DiagnosticBuilder(discarded_);
  }
  std::string identity =
      fmt::format("{} {} {} {} {}", info.code, static_cast<const void*>(where.file),
                  where.span.begin, where.span.end, message);
  if (!told_.insert(std::move(identity)).second) {
    discarded_ = {};
    return DiagnosticBuilder(discarded_);
  }
  std::size_t& count = info.severity == Severity::Error ? errors_ : warnings_;
  if (++count > kMaxPerSeverity) {
    discarded_ = {};
    return DiagnosticBuilder(discarded_);
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
  errors_ = warnings_ = 0;
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
