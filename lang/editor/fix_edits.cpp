#include "lang/editor/fix_edits.hpp"

#include <algorithm>
#include <iterator>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "lang/text/display_width.hpp"

namespace sdlc::lang {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kSpaces = " \t\r\n";
  const std::size_t begin = text.find_first_not_of(kSpaces);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(kSpaces) + 1 - begin);
}

/// A text in a title: one line, of limited length.
std::string shown(std::string_view text) {
  const std::string_view content = trimmed(text);
  if (!content.empty()) return fmt::format("`{}`", printable(abbreviated(content)));
  if (text.find('\n') != std::string_view::npos) return "a line break";
  return text.size() == 1 ? "a space" : "spaces";
}

/// The change in words; the first letter is small.
std::string change_of(const Fix& fix) {
  const std::string_view old = fix.where.file->text(fix.where.span);
  if (fix.replacement.empty()) return fmt::format("remove {}", shown(old));
  if (old.empty()) return fmt::format("insert {}", shown(fix.replacement));
  return fmt::format("replace {} with {}", shown(old), shown(fix.replacement));
}

/// "Replace `a` with `b`, insert `,`"; a change of several places is named once.
std::string title_of(const Diagnostic& diagnostic) {
  constexpr std::size_t kMaxChanges = 2;
  std::vector<std::pair<std::string, std::size_t>> changes;
  for (const Fix& fix : diagnostic.fixes) {
    const std::string change = change_of(fix);
    const auto known =
        std::ranges::find(changes, change, &std::pair<std::string, std::size_t>::first);
    if (known == changes.end()) {
      changes.emplace_back(change, 1);
    } else {
      ++known->second;
    }
  }
  std::string title;
  for (std::size_t i = 0; i < std::min(changes.size(), kMaxChanges); ++i) {
    if (i > 0) title += ", ";
    title += changes[i].first;
    if (changes[i].second > 1) title += fmt::format(" in {} places", changes[i].second);
  }
  if (changes.size() > kMaxChanges) title += ", …";
  title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return title;
}

/// Whether the finding has the code of the other, and its only fix changes the same text in the
/// same way.
bool has_same_fix(const Diagnostic& finding, const Diagnostic& other) {
  if (finding.info != other.info || finding.fixes.size() != 1) return false;
  const Fix &fix = finding.fixes.front(), &wanted = other.fixes.front();
  const SourceFile* file = wanted.where.file;
  return fix.where.file == file && fix.replacement == wanted.replacement &&
         file->text(fix.where.span) == file->text(wanted.where.span);
}

/// "Replace all `a` with `b` in this file (3 places)"
std::string title_of_all(const Fix& fix, std::size_t count) {
  std::string title = change_of(fix);
  title.insert(title.find(' '), " all");
  title.front() = static_cast<char>(title.front() - 'a' + 'A');
  return fmt::format("{} in this file ({} places)", title, count);
}

std::vector<FileEdits> edits_of(const Diagnostic& diagnostic) {
  std::vector<FileEdits> files;
  for (const Fix& fix : diagnostic.fixes) {
    auto file = std::ranges::find(files, fix.where.file, &FileEdits::file);
    if (file == files.end()) {
      files.push_back({.file = fix.where.file, .edits = {}});
      file = std::prev(files.end());
    }
    file->edits.push_back({.where = fix.where.span, .text = fix.replacement});
  }
  for (FileEdits& file : files) {
    std::ranges::stable_sort(file.edits, {}, [](const TextEdit& edit) { return edit.where.begin; });
  }
  return files;
}

}  // namespace

std::optional<QuickFix> QuickFixes::of(const Diagnostic& diagnostic) {
  if (diagnostic.fixes.empty()) return std::nullopt;
  return QuickFix{.title = title_of(diagnostic),
                  .files = edits_of(diagnostic),
                  .is_preferred = is_preferred(diagnostic)};
}

bool QuickFixes::is_preferred(const Diagnostic& diagnostic) {
  return std::ranges::all_of(diagnostic.fixes, [&](const Fix& fix) {
    if (!fix.is_safe) return false;
    const auto guard = guards_.try_emplace(fix.where.file, fix.where.file->text()).first;
    return guard->second.allows(fix);
  });
}

std::optional<QuickFix> fix_everywhere(const Diagnostic& diagnostic,
                                       std::span<const Diagnostic* const> findings) {
  const bool is_change = diagnostic.fixes.size() == 1 && diagnostic.fixes[0].where.span.size() > 0;
  if (!is_change) return std::nullopt;
  const Fix& fix = diagnostic.fixes.front();
  FileEdits all{.file = fix.where.file, .edits = {}};
  for (const Diagnostic* finding : findings) {
    if (!has_same_fix(*finding, diagnostic)) continue;
    all.edits.push_back({.where = finding->fixes.front().where.span, .text = fix.replacement});
  }
  const auto begin_of = [](const TextEdit& edit) { return edit.where.begin; };
  std::ranges::sort(all.edits, {}, begin_of);
  const auto repeated = std::ranges::unique(all.edits, {}, begin_of);
  all.edits.erase(repeated.begin(), repeated.end());
  if (all.edits.size() < 2) return std::nullopt;
  return QuickFix{.title = title_of_all(fix, all.edits.size()), .files = {std::move(all)}};
}

FixAll fix_all(std::unique_ptr<CheckedText> checked, const CheckText& check) {
  const std::string original(checked->file().text());
  const FixResult result = fix_text(std::move(checked), false, check);
  return {.edits = text_edits(original, result.checked->file().text()),
          .applied = result.applied,
          .refused = result.refused};
}

}  // namespace sdlc::lang
