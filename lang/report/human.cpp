#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "lang/report/excerpt.hpp"
#include "lang/report/report.hpp"
#include "lang/report/writers.hpp"
#include "lang/text/display_width.hpp"
#include "lang/text/utf8.hpp"

namespace sdlc::lang {
namespace {

/// Describes a piece of text: its first line in backticks, or by name if it consists of spaces or
/// of one character that may look like another.
std::string named(std::string_view text) {
  if (text.find_first_not_of(' ') == std::string_view::npos) {
    return text.size() == 1 ? "a space" : fmt::format("{} spaces", text.size());
  }
  if (text.front() == '\n') return "a line end";
  const DecodedChar first = decode_utf8(text);
  const bool is_foreign = first.is_valid && first.code_point > 0x7E && first.size == text.size();
  if (is_foreign) return describe_character(first.code_point);
  const std::string_view line = text.substr(0, text.find('\n'));
  const std::string_view rest = line.size() < text.size() ? "…" : "";
  return fmt::format("`{}{}`", printable(abbreviated(line)), rest);
}

std::string_view without_trailing_space(std::string_view text) {
  const std::size_t end = text.find_last_not_of(" \n");
  return end == std::string_view::npos ? text : text.substr(0, end + 1);
}

/// The fix without the unchanged text at both ends.
Fix narrowed(Fix fix) {
  Span& span = fix.where.span;
  std::string_view old = fix.where.file->text(span), wanted = fix.replacement;
  while (!old.empty() && !wanted.empty() && old.back() == wanted.back()) {
    old.remove_suffix(1), wanted.remove_suffix(1), --span.end;
  }
  std::size_t same = 0;
  while (same < std::min(old.size(), wanted.size()) && old[same] == wanted[same]) ++same;
  const auto splits_character = [&](std::string_view text) {
    return same < text.size() && is_continuation(text[same]);
  };
  while (same > 0 && (splits_character(old) || splits_character(wanted))) --same;
  span.begin += static_cast<std::uint32_t>(same);
  fix.replacement = wanted.substr(same);
  return fix;
}

/// Describes the fix in words.
std::string describe_fix(const Diagnostic& diagnostic, const Fix& fix) {
  const Span span = fix.where.span;
  const std::string_view text = fix.where.file->text(span);
  if (fix.replacement.empty()) return "remove " + named(text);
  const std::string replacement = named(without_trailing_space(fix.replacement));
  if (span.size() > 0) {
    if (replacement == "a space") return "write a space instead";
    // If both look the same, show only the difference.
    const Fix change = narrowed(fix);
    if (replacement == named(text) && change.where.span != span) {
      return describe_fix(diagnostic, change);
    }
    return fmt::format("write {} instead of {}", replacement, named(text));
  }

  const Span wrong = diagnostic.where.span;
  if (span.begin == wrong.begin) return "add " + replacement;
  if (span.begin == wrong.end) {
    return fmt::format("add {} after {}", replacement, named(fix.where.file->text(wrong)));
  }
  const Position position = fix.where.file->position(span.begin);
  return fmt::format("add {} at {}:{}", replacement, position.line, position.column);
}

std::vector<std::string> help_lines(const Diagnostic& diagnostic) {
  std::vector<std::string> lines;
  if (!diagnostic.suggestion.empty()) {
    lines.push_back(fmt::format("did you mean {}?", named(diagnostic.suggestion)));
  }
  for (const Fix& fix : diagnostic.fixes) {
    const bool is_suggestion = fix.replacement == diagnostic.suggestion &&
                               fix.where.span == diagnostic.where.span && !fix.replacement.empty();
    if (!is_suggestion) lines.push_back(describe_fix(diagnostic, fix));
  }
  for (const std::string& text : diagnostic.help) lines.push_back(printable(text));
  return lines;
}

/// The marks of a diagnostic by file, its own place first.
std::vector<std::vector<Mark>> marks_by_file(const Diagnostic& diagnostic) {
  std::vector<std::vector<Mark>> files;
  files.push_back({{.where = diagnostic.where, .message = {}, .is_primary = true}});
  for (const Label& label : diagnostic.labels) {
    const auto known = std::find_if(files.begin(), files.end(), [&](const auto& marks) {
      return marks.front().where.file == label.where.file;
    });
    auto& marks = known == files.end() ? files.emplace_back() : *known;
    marks.push_back({.where = label.where, .message = label.message, .is_primary = false});
  }
  return files;
}

/// The number of digits of the largest line number.
int gutter_width(const std::vector<std::vector<Mark>>& files) {
  std::uint32_t line = 1;
  for (const auto& marks : files) {
    for (const Mark& mark : marks) {
      const std::uint32_t end = std::max(mark.where.span.begin + 1, mark.where.span.end);
      line = std::max(line, mark.where.file->position(end - 1).line);
    }
  }
  return static_cast<int>(fmt::formatted_size("{}", line));
}

std::string render_diagnostic(const Diagnostic& diagnostic, const Palette& palette) {
  const bool is_error = diagnostic.info->severity == Severity::Error;
  const std::string_view color = is_error ? palette.error : palette.warning;
  std::string text =
      fmt::format("{}{}[{}]{}{}: {}{}\n", color, severity_name(diagnostic.info->severity),
                  diagnostic.info->code, palette.reset, palette.bold, printable(diagnostic.message),
                  palette.reset);

  int width = 1;
  if (diagnostic.where.file != nullptr) {
    const auto files = marks_by_file(diagnostic);
    width = gutter_width(files);
    for (const auto& marks : files) {
      const Location& place = marks.front().where;
      const bool is_first = place.file == diagnostic.where.file;
      text += fmt::format("{:>{}}{}{}{} {}\n", "", width, palette.gutter,
                          is_first ? "-->" : ":::", palette.reset, describe_place(place));
      text += render_excerpt(marks, width, color, palette);
    }
  }
  for (const ChainLink& link : diagnostic.chain) {
    text += fmt::format("{:>{}} {}={} {}, {}\n", "", width, palette.gutter, palette.reset,
                        printable(link.message), describe_place(link.where));
  }
  for (const std::string& line : help_lines(diagnostic)) {
    text += fmt::format("{:>{}} {}= {}help:{} {}\n", "", width, palette.gutter, palette.help,
                        palette.reset, line);
  }
  return text + "\n";
}

std::string plural(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string summary(const DiagnosticCounts& counts) {
  std::string text;
  if (counts.errors > 0) text = plural(counts.errors, "error");
  if (counts.warnings > 0) text += (text.empty() ? "" : ", ") + plural(counts.warnings, "warning");
  if (counts.omitted > 0) text += fmt::format(" ({} of them not shown)", counts.omitted);
  return text.empty() ? text : text + "\n";
}

class HumanWriter final : public DiagnosticWriter {
 public:
  HumanWriter(std::ostream& out, bool has_color) : out_(out), palette_(make_palette(has_color)) {}

  void write(const Diagnostic& diagnostic) override {
    out_ << render_diagnostic(diagnostic, palette_);
  }
  void finish(const DiagnosticCounts& counts) override { out_ << summary(counts); }

 private:
  std::ostream& out_;
  Palette palette_;
};

}  // namespace

std::unique_ptr<DiagnosticWriter> make_human_writer(std::ostream& out, bool has_color) {
  return std::make_unique<HumanWriter>(out, has_color);
}

}  // namespace sdlc::lang
