#include "lang/diagnostics/fixes.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>
#include <vector>

namespace sdlc::lang {
namespace {

bool may_be_applied(const Diagnostic& diagnostic, const SourceFile& file, bool applies_unsafe) {
  return !diagnostic.fixes.empty() && std::ranges::all_of(diagnostic.fixes, [&](const Fix& fix) {
    return fix.where.file == &file && (fix.is_safe || applies_unsafe);
  });
}

/// Fixes by where they begin. Those of different diagnostics do not touch.
using TakenFixes = std::multimap<std::uint32_t, const Fix*>;

/// Only the last one that begins at or before the end of `span` can touch it.
bool touches_any(const TakenFixes& taken, Span span) {
  const auto next = taken.upper_bound(span.end);
  return next != taken.begin() && std::prev(next)->second->where.span.end >= span.begin;
}

}  // namespace

FixedText apply_fixes(const SourceFile& file, std::span<const Diagnostic* const> diagnostics,
                      bool applies_unsafe) {
  std::vector<const Diagnostic*> wanted;
  for (const Diagnostic* diagnostic : diagnostics) {
    if (may_be_applied(*diagnostic, file, applies_unsafe)) wanted.push_back(diagnostic);
  }
  const auto begin = [](const Diagnostic* d) { return d->fixes.front().where.span.begin; };
  std::ranges::stable_sort(wanted, {}, begin);

  FixedText fixed;
  TakenFixes taken;
  for (const Diagnostic* diagnostic : wanted) {
    const bool is_free = std::ranges::none_of(
        diagnostic->fixes, [&](const Fix& fix) { return touches_any(taken, fix.where.span); });
    if (!is_free) continue;
    for (const Fix& fix : diagnostic->fixes) taken.emplace(fix.where.span.begin, &fix);
    ++fixed.applied;
  }

  std::uint32_t end = 0;
  for (const auto& [from, fix] : taken) {
    fixed.text += file.text({end, from});
    fixed.text += fix->replacement;
    end = fix->where.span.end;
  }
  fixed.text += file.text().substr(end);
  return fixed;
}

}  // namespace sdlc::lang
