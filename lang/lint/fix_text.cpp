#include "lang/lint/fix_text.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "lang/diagnostics/fixes.hpp"
#include "lang/lint/fix_guard.hpp"

namespace sdlc::lang {
namespace {

using Selection = std::vector<const Diagnostic*>;

bool is_safe(const Diagnostic& diagnostic) {
  return std::ranges::all_of(diagnostic.fixes, &Fix::is_safe);
}
bool is_error(const Diagnostic* diagnostic) {
  return diagnostic->info->severity == Severity::Error;
}

/// "`radus` to `radius`", of all fixes of the diagnostic.
std::string describe_change(const SourceFile& file, const Diagnostic& diagnostic) {
  std::string text;
  for (const Fix& fix : diagnostic.fixes) {
    if (!text.empty()) text += ", ";
    const std::string_view old = file.text(fix.where.span);
    text += old.empty()               ? fmt::format("insert `{}`", fix.replacement)
            : fix.replacement.empty() ? fmt::format("remove `{}`", old)
                                      : fmt::format("`{}` to `{}`", old, fix.replacement);
  }
  return text;
}

/// How often a selection may still be split. Time is limited too, because checking a scene may take
/// a second. When the budget is spent, the remaining fixes are judged as a whole.
class Budget {
 public:
  bool is_spent() const { return splits_ == 0 || Clock::now() > end_; }
  bool is_new() const { return splits_ == kMaxSplits; }
  void spend() { --splits_; }
  void renew() { splits_ = kMaxSplits; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr int kMaxSplits = 100;
  static constexpr std::chrono::seconds kMaxTime{4};

  int splits_ = kMaxSplits;
  Clock::time_point end_ = Clock::now() + kMaxTime;
};

/// Tries the fixes of a text together and, if that fails, in halves.
class Round {
 public:
  Round(const CheckedText& base, const CheckText& check, bool is_unsafe, Budget& budget)
      : base_(base),
        check_(check),
        is_unsafe_(is_unsafe),
        budget_(budget),
        errors_(base.error_count()) {}

  void run() {
    const SourceFile& file = base_.file();
    Selection selection = base_.findings().shown;
    std::erase_if(selection, [&](const Diagnostic* diagnostic) {
      return diagnostic->fixes.empty() || is_safe(*diagnostic) == is_unsafe_;
    });
    if (!is_unsafe_ && !selection.empty()) {
      const FixGuard guard(file.text());
      refused_ += std::erase_if(selection, [&](const Diagnostic* diagnostic) {
        return std::ranges::any_of(diagnostic->fixes, [&](const Fix& fix) {
          return fix.where.file == &file && !guard.allows(fix);
        });
      });
    }
    selection = select_fixes(file, selection, is_unsafe_);
    if (!selection.empty()) consider(selection);
  }

  std::unique_ptr<CheckedText> take_result() { return std::move(result_); }
  const Selection& accepted() const { return accepted_; }
  std::size_t refused() const { return refused_; }

 private:
  void consider(std::span<const Diagnostic* const> part) {
    Selection all = accepted_;
    all.insert(all.end(), part.begin(), part.end());
    std::unique_ptr<CheckedText> checked = check_(fixed_text(base_.file(), all));
    if (is_good(part, *checked)) {
      errors_ = checked->error_count();
      accepted_ = std::move(all);
      result_ = std::move(checked);
    } else if (part.size() == 1 || budget_.is_spent()) {
      refused_ += part.size();
    } else {
      budget_.spend();
      consider(part.first(part.size() / 2));
      consider(part.subspan(part.size() / 2));
    }
  }

  /// Whether each of the fixes removed its error. A fix may uncover a later error: that is accepted
  /// for a safe fix, not for a guess.
  bool is_good(std::span<const Diagnostic* const> part, const CheckedText& checked) const {
    const std::size_t errors = checked.error_count();
    const auto fixed = static_cast<std::size_t>(std::ranges::count_if(part, is_error));
    if (errors + fixed <= errors_) return true;
    const bool is_last_try = part.size() == 1 || budget_.is_spent();
    if (!is_last_try || is_unsafe_ || errors > errors_) return false;
    return part.size() > 1 || !breaks_line_of(*part.front(), checked);
  }

  /// Whether the line of the fix now has a syntax error without a safe fix: the fix was wrong.
  bool breaks_line_of(const Diagnostic& fixed, const CheckedText& checked) const {
    const std::uint32_t line = base_.file().position(fixed.fixes.front().where.span.begin).line;
    return std::ranges::any_of(checked.findings().shown, [&](const Diagnostic* found) {
      return is_error(found) && found->info->code.starts_with("E0") &&
             (found->fixes.empty() || !is_safe(*found)) && found->where.file == &checked.file() &&
             checked.file().position(found->where.span.begin).line == line;
    });
  }

  const CheckedText& base_;
  const CheckText& check_;
  bool is_unsafe_;
  Budget& budget_;
  std::size_t errors_;
  Selection accepted_;
  std::unique_ptr<CheckedText> result_;
  std::size_t refused_ = 0;
};

class Fixer {
 public:
  Fixer(std::unique_ptr<CheckedText> checked, bool applies_unsafe, const CheckText& check)
      : applies_unsafe_(applies_unsafe), check_(check) {
    now_.checked = std::move(checked);
  }

  FixResult run() {
    // Fixes may undo each other or cause others forever. Stop after some rounds without progress,
    // and return to the best text.
    constexpr int kMaxIdleRounds = 10;
    int idle_rounds = 0;
    note_best();
    while (true) {
      if (is_progress()) {
        idle_rounds = 0;
        note_best();
      } else if (++idle_rounds > kMaxIdleRounds) {
        return best();
      }
      if (rounds()) continue;
      if (budget_.is_new()) return std::move(now_);
      // When splits ran out, fixes were judged in groups: retry the rest with a new budget.
      budget_.renew();
      if (!rounds()) return std::move(now_);
    }
  }

 private:
  /// Errors, warnings and bytes, compared in this order. The bytes count because the removal of an
  /// unused name may leave another unused.
  using Score = std::tuple<std::size_t, std::size_t, std::size_t>;

  Score score() const {
    return {now_.checked->error_count(), now_.checked->findings().counts.warnings,
            now_.checked->file().text().size()};
  }
  bool is_progress() const { return score() < best_score_; }

  void note_best() {
    best_score_ = score();
    best_text_ = now_.checked->file().text();
    best_applied_ = now_.applied;
    best_guesses_ = now_.guesses.size();
  }
  FixResult best() {
    now_.checked = check_(best_text_);
    now_.refused += now_.applied - best_applied_;
    now_.applied = best_applied_;
    now_.guesses.resize(best_guesses_);
    return std::move(now_);
  }

  bool rounds() {
    now_.refused = 0;
    return round(false) || (applies_unsafe_ && round(true));
  }

  /// Whether any fix was applied.
  bool round(bool is_unsafe) {
    Round round(*now_.checked, check_, is_unsafe, budget_);
    round.run();
    now_.refused += round.refused();
    if (round.accepted().empty()) return false;
    const SourceFile& file = now_.checked->file();
    for (const Diagnostic* diagnostic : round.accepted()) {
      if (is_safe(*diagnostic)) continue;
      now_.guesses.push_back({.where = file.position(diagnostic->fixes[0].where.span.begin),
                              .info = diagnostic->info,
                              .change = describe_change(file, *diagnostic)});
    }
    now_.applied += round.accepted().size();
    now_.checked = round.take_result();
    return true;
  }

  bool applies_unsafe_;
  const CheckText& check_;
  Budget budget_;
  FixResult now_;
  Score best_score_;
  std::string best_text_;
  std::size_t best_applied_ = 0, best_guesses_ = 0;
};

}  // namespace

FixResult fix_text(std::unique_ptr<CheckedText> checked, bool applies_unsafe,
                   const CheckText& check) {
  return Fixer(std::move(checked), applies_unsafe, check).run();
}

}  // namespace sdlc::lang
