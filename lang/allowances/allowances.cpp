#include "lang/allowances/allowances.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>
#include <utility>

#include "lang/syntax/syntax.hpp"
#include "lang/text/nearest_name.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kMark = "sdlc:";

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

bool is_statement(SyntaxKind kind) {
  return kind >= SyntaxKind::Property && kind <= SyntaxKind::Object;
}

bool contains(Span span, std::uint32_t offset) {
  return span.begin <= offset && offset <= span.end;
}

/// Reads a comment from left to right.
class Scanner {
 public:
  Scanner(std::string_view text, Span span) : text_(text), at_(span.begin), end_(span.end) {}

  void skip_blanks() {
    while (at_ < end_ && is_blank(text_[at_])) ++at_;
  }
  bool take(std::string_view expected) {
    skip_blanks();
    if (!text_.substr(at_, end_ - at_).starts_with(expected)) return false;
    at_ += static_cast<std::uint32_t>(expected.size());
    return true;
  }
  Span take_word() {
    skip_blanks();
    const std::uint32_t begin = at_;
    while (at_ < end_ && std::isalnum(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return {begin, at_};
  }

 private:
  std::string_view text_;
  std::uint32_t at_, end_;
};

/// The codes of `// sdlc: allow(W402, W4) reason`; empty where it cannot be read so.
std::vector<Span> read_codes(std::string_view text, Span comment) {
  Scanner scanner(text, comment);
  if (!scanner.take("//") || !scanner.take(kMark) || !scanner.take("allow") || !scanner.take("(")) {
    return {};
  }
  std::vector<Span> codes;
  do {
    codes.push_back(scanner.take_word());
    if (codes.back().size() == 0) return {};
  } while (scanner.take(","));
  return scanner.take(")") ? codes : std::vector<Span>();
}

/// The statements that a comment speaks of.
std::vector<Span> places_of(const SyntaxTree& tree, std::size_t comment) {
  const std::string_view text = tree.file().text();
  const Span span = tree.comments()[comment].span;
  const std::size_t line_break = text.substr(0, span.begin).rfind('\n');
  const auto line = static_cast<std::uint32_t>(line_break + 1);  // npos + 1 is 0
  const std::string_view before = text.substr(line, span.begin - line);
  if (std::ranges::all_of(before, is_blank)) {
    // The statement that begins at the next token.
    std::uint32_t at = span.end;
    for (++comment;; ++comment) {
      while (at < text.size() && is_blank(text[at])) ++at;
      if (comment == tree.comments().size() || tree.comments()[comment].span.begin != at) break;
      at = tree.comments()[comment].span.end;
    }
    for (const SyntaxNode& node : tree.nodes()) {
      if (node.begin == at && is_statement(node.kind)) return {node.span()};
    }
    return {};
  }

  std::vector<Span> places;
  std::optional<Span> around;
  for (const SyntaxNode& node : tree.nodes()) {
    if (!is_statement(node.kind)) continue;
    if (node.begin >= span.begin) break;
    const bool is_inside_other = !places.empty() && contains(places.back(), node.begin);
    if (node.begin >= line && !is_inside_other) places.push_back(node.span());
    if (node.begin < line && node.end >= line) around = node.span();  // the innermost comes last
  }
  if (places.empty() && around) places.push_back(*around);
  return places;
}

bool fits_some_warning(std::string_view code) {
  return std::ranges::any_of(all_diagnostics(), [&](const DiagnosticInfo* info) {
    return info->severity != Severity::Error && info->code.starts_with(code);
  });
}

bool fits_some_error(std::string_view code) {
  return std::ranges::any_of(all_diagnostics(), [&](const DiagnosticInfo* info) {
    return info->severity == Severity::Error && info->code.starts_with(code);
  });
}

/// The comment with the blanks before it, and its line if nothing else is on it.
Span with_blanks(std::string_view text, Span comment) {
  Span span = comment;
  while (span.begin > 0 && (text[span.begin - 1] == ' ' || text[span.begin - 1] == '\t')) {
    --span.begin;
  }
  const bool is_alone = span.begin == 0 || text[span.begin - 1] == '\n';
  if (!is_alone) return span;
  if (span.end < text.size() && text[span.end] == '\r') ++span.end;
  if (span.end < text.size() && text[span.end] == '\n') ++span.end;
  return span;
}

}  // namespace

Allowances::FileAllowances Allowances::read(const SourceFile& file) {
  FileAllowances result;
  const bool has_some = file.text().find(kMark) != std::string_view::npos;
  if (file.format() != SourceFormat::Scene || !has_some) return result;
  DiagnosticSink ignored;
  const SyntaxTree tree = parse(file, ignored);
  for (std::size_t i = 0; i < tree.comments().size(); ++i) {
    const Comment& comment = tree.comments()[i];
    Scanner scanner(file.text(), comment.span);
    if (comment.kind != CommentKind::Line || !scanner.take("//") || !scanner.take(kMark)) continue;
    const std::vector<Span> codes = read_codes(file.text(), comment.span);
    if (codes.empty()) result.unreadable.push_back(comment.span);
    for (std::uint32_t k = 0; k < codes.size(); ++k) {
      result.list.push_back({.code = codes[k],
                             .comment = comment.span,
                             .index = k,
                             .count = static_cast<std::uint32_t>(codes.size()),
                             .places = places_of(tree, i)});
    }
  }
  return result;
}

Allowances::FileAllowances& Allowances::of(const SourceFile& file) {
  const auto found = files_.find(&file);
  return found != files_.end() ? found->second : files_.emplace(&file, read(file)).first->second;
}

bool Allowances::allow(const DiagnosticInfo& info, Location where) {
  if (where.file == nullptr || info.severity == Severity::Error) return false;
  bool is_allowed = false;
  for (Allowance& allowance : of(*where.file).list) {
    if (!info.code.starts_with(where.file->text(allowance.code))) continue;
    const bool is_here = std::ranges::any_of(
        allowance.places, [&](Span place) { return contains(place, where.span.begin); });
    if (!is_here) continue;
    is_allowed = allowance.is_used = true;
  }
  return is_allowed;
}

void Allowances::diagnose_unused(const SourceFile& file, DiagnosticSink& sink) {
  const FileAllowances& allowances = of(file);
  for (const Span comment : allowances.unreadable) {
    sink.report(diag::bad_allowance, {&file, comment}, "this comment cannot be read")
        .help("an allowance is written `// sdlc: allow(W402) reason`");
  }
  for (const Allowance& allowance : allowances.list) diagnose_unused(file, allowance, sink);
}

void Allowances::diagnose_unused(const SourceFile& file, const Allowance& allowance,
                                 DiagnosticSink& sink) {
  const std::string_view code = file.text(allowance.code);
  const Location where{&file, allowance.code};
  if (!fits_some_warning(code)) {
    if (fits_some_error(code)) {
      sink.report(diag::bad_allowance, where, fmt::format("`{}` is an error", code))
          .help("errors cannot be allowed: after one there is no picture");
      return;
    }
    std::vector<std::string_view> codes;
    for (const DiagnosticInfo* info : all_diagnostics()) {
      if (info->severity != Severity::Error) codes.push_back(info->code);
    }
    sink.report(diag::bad_allowance, where, fmt::format("no warning has the code `{}`", code))
        .suggest(nearest_name(code, codes));
    return;
  }
  // What only `sdlc convert` reports cannot be seen to be of use.
  if (allowance.is_used || diag::rounded_color.code.starts_with(code)) return;
  auto report = sink.report(diag::unused_allowance, where, code);
  if (allowance.places.empty()) report.help("no statement stands here");
  if (allowance.count == 1) {
    report.unsafe_fix({&file, with_blanks(file.text(), allowance.comment)}, "");
  } else if (allowance.index == 0) {
    Span span = allowance.code;
    while (is_blank(file.text()[span.end]) || file.text()[span.end] == ',') ++span.end;
    report.unsafe_fix({&file, span}, "");
  } else {
    Span span = allowance.code;
    while (is_blank(file.text()[span.begin - 1]) || file.text()[span.begin - 1] == ',') {
      --span.begin;
    }
    report.unsafe_fix({&file, span}, "");
  }
}

}  // namespace sdlc::lang
