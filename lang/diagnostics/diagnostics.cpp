#include "lang/diagnostics/diagnostics.hpp"

#include <algorithm>
#include <array>
#include <functional>

namespace sdlc::lang {

std::span<const DiagnosticInfo* const> all_diagnostics() noexcept {
  static constexpr auto kAll = std::to_array<const DiagnosticInfo*>({
#define SDLC_DIAGNOSTIC(code, severity, name, message, ...) &diag::name,
#include "lang/diagnostics/diagnostics.def"
#undef SDLC_DIAGNOSTIC
  });
  return kAll;
}

std::string title_of(const DiagnosticInfo& info) {
  std::string title(info.name);
  std::ranges::replace(title, '_', ' ');
  return title;
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

DiagnosticBuilder DiagnosticSink::discard() {
  discarded_ = {};
  return DiagnosticBuilder(discarded_, false);
}

DiagnosticBuilder DiagnosticSink::add(const DiagnosticInfo& info, Location where,
                                      std::string message) {
  if (is_muted_) return discard();
  const std::string place =
      fmt::format("{} {} {} {} ", info.code, static_cast<const void*>(where.file), where.span.begin,
                  where.span.end);
  const std::hash<std::string_view> hash;
  has_errors_ |= info.severity == Severity::Error;
  // Past this many, duplicates are no longer detected.
  constexpr std::size_t kMaxDistinct = 1'000'000;
  if (seen_.size() < kMaxDistinct && !seen_.insert(hash(place) * 31 + hash(message)).second) {
    return discard();
  }
  const bool is_error = info.severity == Severity::Error;
  if (++(is_error ? errors_ : warnings_) > (is_error ? kMaxErrors : kMaxWarnings)) {
    ++not_kept_[&info];
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

void DiagnosticSink::add(const Diagnostic& diagnostic) {
  if (add(*diagnostic.info, diagnostic.where, diagnostic.message).is_kept()) {
    std::vector<ChainLink> links = std::move(diagnostics_.back().chain);
    diagnostics_.back() = diagnostic;
    if (diagnostic.chain.empty()) diagnostics_.back().chain = std::move(links);
  }
}

void DiagnosticSink::add(const DiagnosticSink& other) {
  if (is_muted_) return;
  for (const Diagnostic& diagnostic : other.diagnostics()) add(diagnostic);
  for (const auto& [info, count] : other.not_kept()) {
    not_kept_[info] += count;
    (info->severity == Severity::Error ? errors_ : warnings_) += count;
    has_errors_ |= info->severity == Severity::Error;
  }
}

void DiagnosticSink::clear() {
  diagnostics_.clear();
  not_kept_.clear();
  has_errors_ = false;
  errors_ = warnings_ = 0;
}

}  // namespace sdlc::lang
