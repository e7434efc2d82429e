#include "lang/editor/formatting.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "lang/ast/statements.hpp"
#include "lang/format/format.hpp"
#include "lang/report/findings.hpp"
#include "lang/token/lines.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

std::string short_name(const Document& file) {
  return std::filesystem::path(file.name()).filename().string();
}

/// Why the text cannot be formatted; nullopt if it can.
std::optional<Formatting> refusal_of(const Document& file) {
  if (file.format() == SourceFormat::Json) {
    return Formatting{.refusal = fmt::format("`{}` was not formatted: it is a JSON config, and "
                                             "only scenes have a canonical layout",
                                             short_name(file))};
  }
  DiagnosticSink sink;
  file.tree(sink);
  if (!sink.has_errors()) return std::nullopt;
  const Findings findings = select_findings(sink);
  const auto first =
      std::ranges::find(findings.shown, Severity::Error,
                        [](const Diagnostic* found) { return found->info->severity; });
  const Diagnostic& error = **first;
  const Position at = file.position(error.where.span.begin);
  return Formatting{.refusal = fmt::format("`{}` was not formatted because of an error in line {}, "
                                           "column {}: {}",
                                           short_name(file), at.line, at.column, error.message),
                    .cause = error.where.span};
}

bool has_crlf(std::string_view text) {
  const std::size_t first = text.find('\n');
  return first != std::string_view::npos && first > 0 && text[first - 1] == '\r';
}

std::string with_crlf(std::string_view lines) {
  std::string result;
  for (const char c : lines) {
    if (c == '\n') result += '\r';
    result += c;
  }
  return result;
}

/// The whole text in the layout, with the editor's line ends and byte order mark.
std::string formatted_text(const Document& file) {
  DiagnosticSink ignored;
  std::string formatted = *format_file(file, ignored);
  if (has_crlf(file.text())) formatted = with_crlf(formatted);
  if (file.text().starts_with(kByteOrderMark)) formatted.insert(0, kByteOrderMark);
  return formatted;
}

std::vector<TextEdit> edits_of_lines(const Document& file, LineRange lines) {
  DiagnosticSink ignored;
  return text_edits(file.text(), *format_file(file, ignored, lines));
}

LineRange lines_of_range(const SourceFile& file, Span range) {
  const std::uint32_t first = file.position(range.begin).line;
  std::uint32_t last = std::max(first, file.position(range.end).line);
  if (last > first && file.line_begin(last) == range.end) --last;
  return {.first = first, .last = last};
}

/// The statement whose last brace is before `caret`.
std::optional<Span> statement_closed_at(const SyntaxTree& tree, std::uint32_t caret) {
  if (caret == 0 || tree.file().text()[caret - 1] != '}') return std::nullopt;
  std::optional<Span> statement;
  for (const SyntaxNode& node : tree.nodes()) {
    if (node.begin >= caret) break;
    // A block is a part of the statement that began last and contains it.
    if (ast::is_statement(node.kind) && node.end >= caret) statement = node.span();
    const bool has_brace = node.kind == SyntaxKind::Object || node.kind == SyntaxKind::Block;
    if (has_brace && node.end == caret) return statement;
  }
  return std::nullopt;
}

/// The last statement that ends in the line before that of `caret`, unless it ends with a brace.
std::optional<Span> statement_ended_before(const SyntaxTree& tree, std::uint32_t caret) {
  const std::string_view text = tree.file().text();
  const std::uint32_t line = line_begin(text, caret);
  if (line == 0) return std::nullopt;
  const std::uint32_t previous = line_begin(text, line - 1);
  std::optional<Span> statement;
  for (const SyntaxNode& node : tree.nodes()) {
    if (node.begin >= line) break;
    const bool ends_there = node.end > previous && node.end < line;
    if (!ast::is_statement(node.kind) || !ends_there) continue;
    if (!statement || node.end > statement->end) statement = node.span();
  }
  if (statement && text[statement->end - 1] == '}') return std::nullopt;
  return statement;
}

/// Whether the edits change no more than the layout.
bool keep_program(const SyntaxTree& tree, const std::vector<TextEdit>& edits) {
  const Document edited(tree.file().name(), with_edits(tree.file().text(), edits));
  DiagnosticSink sink;
  const SyntaxTree& result = edited.tree(sink);
  return !sink.has_errors() && is_same_program(tree, result);
}

/// The edits inside `place`, of which only the beginning belongs to it; none if one of them crosses
/// its border.
std::vector<TextEdit> edits_inside(const SyntaxTree& tree, std::vector<TextEdit> edits,
                                   Span place) {
  const bool begins_line = line_begin(tree.file().text(), place.begin) == place.begin;
  const auto is_outside = [&](const TextEdit& edit) {
    const auto [begin, end] = edit.where;
    const bool ends_at_border = end == place.begin && (begin < end || !begins_line);
    return end < place.begin || ends_at_border || begin >= place.end;
  };
  const auto dropped = std::erase_if(edits, is_outside);
  const bool crosses = std::ranges::any_of(edits, [&](const TextEdit& edit) {
    return edit.where.begin < place.begin || edit.where.end > place.end;
  });
  if (crosses || (dropped > 0 && !keep_program(tree, edits))) return {};
  return edits;
}

}  // namespace

Formatting format_text(const Document& file) {
  if (auto refused = refusal_of(file)) return *std::move(refused);
  return {.edits = text_edits(file.text(), formatted_text(file))};
}

Formatting format_range(const Document& file, Span range) {
  if (auto refused = refusal_of(file)) return *std::move(refused);
  return {.edits = edits_of_lines(file, lines_of_range(file, range))};
}

Formatting format_on_type(const Document& file, std::uint32_t caret, std::string_view typed) {
  if (auto refused = refusal_of(file)) return *std::move(refused);
  const std::string_view text = file.text();
  caret = std::min(caret, static_cast<std::uint32_t>(text.size()));
  DiagnosticSink ignored;
  const SyntaxTree& tree = file.tree(ignored);
  const bool is_brace = typed == "}";
  const std::optional<Span> statement =
      is_brace ? statement_closed_at(tree, caret) : statement_ended_before(tree, caret);
  if (!statement) return {};

  Span place{statement->begin, caret};
  if (!is_brace) {  // up to the end of the line before
    place.end = line_begin(text, caret) - 1;
    if (text[place.end - 1] == '\r') --place.end;
  }
  if (is_first_of_line(text, place.begin)) place.begin = line_begin(text, place.begin);
  std::vector<TextEdit> edits = edits_of_lines(file, lines_of_range(file, *statement));
  return {.edits = edits_inside(tree, std::move(edits), place)};
}

}  // namespace sdlc::lang
