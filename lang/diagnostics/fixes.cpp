#include "lang/diagnostics/fixes.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <map>

namespace sdlc::lang {
namespace {

bool may_be_applied(const Diagnostic& diagnostic, const SourceFile& file, bool applies_unsafe) {
  return !diagnostic.fixes.empty() && std::ranges::all_of(diagnostic.fixes, [&](const Fix& fix) {
    return fix.where.file == &file && (fix.is_safe || applies_unsafe);
  });
}

/// Spans that do not touch each other, with lookup in logarithmic time.
class DisjointSpans {
 public:
  bool touches(Span span) const {
    const auto next = ends_.upper_bound(span.end);  // begins beyond the span
    return next != ends_.begin() && std::prev(next)->second >= span.begin;
  }
  void add(Span span) {
    std::uint32_t& end = ends_[span.begin];
    end = std::max(end, span.end);
  }

 private:
  std::map<std::uint32_t, std::uint32_t> ends_;  // by begin
};

}  // namespace

std::vector<const Diagnostic*> select_fixes(const SourceFile& file,
                                            std::span<const Diagnostic* const> diagnostics,
                                            bool applies_unsafe) {
  std::vector<const Diagnostic*> wanted;
  for (const Diagnostic* diagnostic : diagnostics) {
    if (may_be_applied(*diagnostic, file, applies_unsafe)) wanted.push_back(diagnostic);
  }
  const auto begin = [](const Diagnostic* d) { return d->fixes.front().where.span.begin; };
  std::ranges::stable_sort(wanted, {}, begin);

  DisjointSpans taken;
  std::erase_if(wanted, [&](const Diagnostic* diagnostic) {
    const auto touches = [&](const Fix& fix) { return taken.touches(fix.where.span); };
    if (std::ranges::any_of(diagnostic->fixes, touches)) return true;
    for (const Fix& fix : diagnostic->fixes) taken.add(fix.where.span);
    return false;
  });
  return wanted;
}

std::string fixed_text(const SourceFile& file, std::span<const Diagnostic* const> selected) {
  std::vector<const Fix*> fixes;
  for (const Diagnostic* diagnostic : selected) {
    for (const Fix& fix : diagnostic->fixes) fixes.push_back(&fix);
  }
  std::ranges::stable_sort(fixes, {}, [](const Fix* fix) { return fix->where.span.begin; });

  std::string text;
  std::uint32_t end = 0;
  for (const Fix* fix : fixes) {
    text += file.text({end, fix->where.span.begin});
    text += fix->replacement;
    end = fix->where.span.end;
  }
  text += file.text().substr(end);
  return text;
}

FixedText apply_fixes(const SourceFile& file, std::span<const Diagnostic* const> diagnostics,
                      bool applies_unsafe) {
  const auto selected = select_fixes(file, diagnostics, applies_unsafe);
  return {.text = fixed_text(file, selected), .applied = selected.size()};
}

}  // namespace sdlc::lang
