#include "lang/diagnostics/fixes.hpp"

#include <algorithm>
#include <vector>

namespace sdlc::lang {
namespace {

bool may_be_applied(const Diagnostic& diagnostic, const SourceFile& file, bool applies_unsafe) {
  return !diagnostic.fixes.empty() && std::ranges::all_of(diagnostic.fixes, [&](const Fix& fix) {
    return fix.where.file == &file && (fix.is_safe || applies_unsafe);
  });
}

bool touch(Span a, Span b) { return a.begin <= b.end && b.begin <= a.end; }

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
  std::vector<const Fix*> taken;
  for (const Diagnostic* diagnostic : wanted) {
    const bool is_free = std::ranges::none_of(diagnostic->fixes, [&](const Fix& fix) {
      return std::ranges::any_of(
          taken, [&](const Fix* other) { return touch(fix.where.span, other->where.span); });
    });
    if (!is_free) continue;
    for (const Fix& fix : diagnostic->fixes) taken.push_back(&fix);
    ++fixed.applied;
  }
  std::ranges::sort(taken, {}, [](const Fix* fix) { return fix->where.span.begin; });

  std::uint32_t end = 0;
  for (const Fix* fix : taken) {
    fixed.text += file.text({end, fix->where.span.begin});
    fixed.text += fix->replacement;
    end = fix->where.span.end;
  }
  fixed.text += file.text().substr(end);
  return fixed;
}

}  // namespace sdlc::lang
