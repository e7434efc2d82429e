#include "lang/lint/fix_text.hpp"

#include <algorithm>
#include <chrono>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/diagnostics/fixes.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

using Selection = std::vector<const Diagnostic*>;

/// The strings and comments of a text, by place.
class OpaqueSpans {
 public:
  explicit OpaqueSpans(std::string_view text) : text_(text) {
    TokenReader tokens(text);
    for (Token token = tokens.next(); token.kind != TokenKind::End; token = tokens.next()) {
      if (is_comment(token.kind) || lang::is_string(token.kind)) spans_.push_back(token.span);
    }
  }

  bool are_kept_by(const Fix& fix) const {
    const Span changed = fix.where.span;
    const auto ends_before = [](const Span& span, std::uint32_t at) { return span.end < at; };
    auto span = std::lower_bound(spans_.begin(), spans_.end(), changed.begin, ends_before);
    for (; span != spans_.end() && span->begin <= changed.end; ++span) {
      if (!is_kept_by(fix, *span)) return false;
    }
    return true;
  }

 private:
  bool is_kept_by(const Fix& fix, Span span) const {
    const Span changed = fix.where.span;
    if (changed.end <= span.begin) return true;
    // What is inserted after an open end becomes a part of it.
    if (changed.begin >= span.end) return changed.begin > span.end || is_closed(span);
    const bool is_whole = changed.begin <= span.begin && changed.end >= span.end;
    return is_whole && is_closed(span) && fix.replacement.find(content(span)) != std::string::npos;
  }

  bool is_string(Span span) const { return text_[span.begin] == '"'; }
  bool is_line_comment(Span span) const { return text_[span.begin + 1] == '/'; }
  bool is_closed(Span span) const {
    const std::string_view text = text_.substr(span.begin, span.size());
    if (is_string(span)) return text.size() > 1 && text.ends_with('"');
    return !is_line_comment(span) && text.ends_with("*/");
  }
  std::string_view content(Span span) const {
    const std::uint32_t quote = is_string(span) ? 1 : 0;
    return text_.substr(span.begin + quote, span.size() - 2 * quote);
  }

  std::string_view text_;
  std::vector<Span> spans_;
};

/// Whether the fix changes a part of a sign such as `:=` or `=>` and leaves the rest.
bool splits_sign(std::string_view text, const Fix& fix) {
  constexpr std::string_view kSigns = "=:<>!&|*%^~?";
  const auto is_sign = [&](std::size_t at) {
    return at < text.size() && kSigns.find(text[at]) != std::string_view::npos;
  };
  auto [begin, end] = fix.where.span;
  while (begin < end && text[begin] == ' ') ++begin;  // of a name, and of what follows it
  if (begin == end || !is_sign(begin) || !is_sign(end - 1)) return false;
  if (is_sign(end) || (begin > 0 && is_sign(begin - 1))) return true;
  // `= =` is one slip, `&& !` two signs.
  const auto is_equals = [&](std::size_t at) {
    return at < text.size() && (text[at] == '=' || text[at] == ':');
  };
  if (!is_equals(begin)) return false;
  while (begin > 0 && text[begin - 1] == ' ') --begin;
  while (end < text.size() && text[end] == ' ') ++end;
  return is_equals(end) || (begin > 0 && is_equals(begin - 1));
}

/// Whether the fix makes one word of a part of the text and what it writes beside it. A unit stands
/// directly after its number.
bool glues_words(std::string_view text, const Fix& fix) {
  const auto [begin, end] = fix.where.span;
  const std::string& written = fix.replacement;
  if (written.empty()) return false;
  const auto is_word = [](char c) { return is_idchar(c) || static_cast<unsigned char>(c) >= 0x80; };
  const bool begins_with_word = begin < end && is_idchar(text[begin]);
  const bool ends_with_word = begin < end && is_idchar(text[end - 1]);
  const bool is_unit = written == "deg" && begin > 0 && is_digit(text[begin - 1]);
  const bool before = begin > 0 && is_word(text[begin - 1]) && is_idchar(written.front());
  const bool after = end < text.size() && is_word(text[end]) && is_idchar(written.back());
  return (before && !begins_with_word && !is_unit) || (after && !ends_with_word);
}

constexpr std::string_view kQuotes[] = {"'", "“", "”", "„", "‘", "’"};

/// Whether the fix is inside quotes that are none of the language, or writes a quote where they do
/// not make plain pairs: what is a string there is not certain.
bool is_among_quotes(std::string_view text, const Fix& fix) {
  const std::size_t at_fix = fix.where.span.begin;
  const std::size_t begin = at_fix == 0 ? 0 : text.rfind('\n', at_fix - 1) + 1;
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  const auto starts_at_fix = [&](std::string_view quote) {
    return text.substr(at_fix).starts_with(quote);
  };
  const bool is_quote = std::ranges::any_of(kQuotes, starts_at_fix);  // a closing one is inside
  std::size_t before = 0, all = 0;
  bool touches_word = false;
  for (std::size_t at = begin; at < end; ++at) {
    for (const std::string_view quote : kQuotes) {
      if (!text.substr(at).starts_with(quote)) continue;
      ++all;
      if (at < at_fix) ++before;
      const bool opens = all % 2 == 1;
      if (opens ? at == begin : at + quote.size() == end) continue;
      const char beside = opens ? text[at - 1] : text[at + quote.size()];
      touches_word |=
          is_idchar(beside) || beside == '\'' || static_cast<unsigned char>(beside) >= 0x80;
    }
  }
  const bool writes_quote = fix.replacement.find('"') != std::string::npos;
  return (!is_quote && before % 2 == 1) ||
         (writes_quote && all > 0 && (all % 2 == 1 || touches_word));
}

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

/// How often a selection may still be split. Checking a scene may take a second, so time counts
/// too: what is left then is judged as a whole.
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

/// The fixes of one text, tried out together and, where that fails, in halves.
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
      const OpaqueSpans opaque(file.text());
      refused_ += std::erase_if(selection, [&](const Diagnostic* diagnostic) {
        return std::ranges::any_of(diagnostic->fixes, [&](const Fix& fix) {
          return fix.where.file == &file &&
                 (!opaque.are_kept_by(fix) || splits_sign(file.text(), fix) ||
                  glues_words(file.text(), fix) || is_among_quotes(file.text(), fix));
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

  /// Whether each of the fixes did its work. Fixing one error may uncover a later one: accepted for
  /// a safe fix, not for a guess.
  bool is_good(std::span<const Diagnostic* const> part, const CheckedText& checked) const {
    const std::size_t errors = checked.error_count();
    const auto fixed = static_cast<std::size_t>(std::ranges::count_if(part, is_error));
    if (errors + fixed <= errors_) return true;
    const bool is_last_try = part.size() == 1 || budget_.is_spent();
    if (!is_last_try || is_unsafe_ || errors > errors_) return false;
    return part.size() > 1 || !breaks_line_of(*part.front(), checked);
  }

  /// Whether the text now has a syntax error in the line of the fix for which there is no safe fix:
  /// the line was not meant like that.
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
    // Fixes that undo each other, or make room for more of their kind, come to an end after some
    // rounds without progress; what they did is undone.
    constexpr int kMaxRoundsInVain = 10;
    int in_vain = 0;
    note_best();
    while (true) {
      if (is_progress()) {
        in_vain = 0;
        note_best();
      } else if (++in_vain > kMaxRoundsInVain) {
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
  /// Errors and warnings: fewer of the first count more.
  using Score = std::pair<std::size_t, std::size_t>;

  Score score() const {
    return {now_.checked->error_count(), now_.checked->findings().counts.warnings};
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

bool keeps_strings_and_comments(std::string_view text, const Fix& fix) {
  return OpaqueSpans(text).are_kept_by(fix);
}

}  // namespace sdlc::lang
