#include <algorithm>
#include <cstdint>
#include <optional>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

#include "lang/repair/scene_repair.hpp"
#include "lang/syntax/broken_parts.hpp"
#include "lang/syntax/characters.hpp"
#include "lang/syntax/statements.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/syntax/tree_builder.hpp"

namespace sdlc::lang {
namespace {

/// A text that is one expression and nothing else.
struct lone_expression
    : pegtl::seq<grammar::space, pegtl::must<grammar::property_value, grammar::file_end>> {};

/// The result of reading a text once.
struct Reading {
  NodeBuffer<SyntaxNode> nodes;
  std::vector<Comment> comments;
  DiagnosticSink sink;
  std::vector<std::uint32_t> misplaced;  ///< TreeBuilder::misplaced
  bool is_foreign = false;

  bool is_sound() const { return !sink.has_errors() && misplaced.empty(); }
};

/// Converts positions in the repaired text to positions in the file. The value of a literal is read
/// from the file later: a literal that was repaired is an Error.
void move_to_file(Reading& reading, const SourceFile& file, const RepairedText& repaired) {
  for (SyntaxNode& node : reading.nodes.span()) {
    const Span span = repaired.in_source(node.span()), before = node.span();
    node.begin = span.begin;
    node.end = span.end;
    const bool is_literal = node.kind == SyntaxKind::Number || node.kind == SyntaxKind::String;
    if (!is_literal) continue;
    const std::string_view read =
        std::string_view(repaired.text()).substr(before.begin, before.size());
    if (file.text(span) != read) node.kind = SyntaxKind::Error;
  }
  for (Comment& comment : reading.comments) comment.span = repaired.in_source(comment.span);
}

template <typename Rule>
Reading read(const SourceFile& file, std::string_view text, const RepairedText* repaired,
             const StopRequest* stop) {
  DiagnosticSink sink(stop);
  TreeBuilder builder(file, text, repaired, sink);
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf, const char*> in(
      text.data(), text.data() + text.size(), "");
  builder.push(SyntaxKind::File, {0, 0});
  try {
    pegtl::parse<Rule, Build, Control>(in, builder);
  } catch (const ParseAbandoned&) {
  } catch (const Reported&) {
  }
  builder.close(0);
  builder.node(0).end = static_cast<std::uint32_t>(text.size());
  Reading reading{builder.take_nodes(), builder.take_comments(), std::move(sink),
                  std::move(builder.misplaced), builder.is_foreign};
  if (repaired != nullptr) move_to_file(reading, file, *repaired);
  return reading;
}

Span whole(std::string_view text) { return {0, static_cast<std::uint32_t>(text.size())}; }

/// Repairs each part of the text. Afterwards `parts` are where they have moved to.
template <typename Repair>
void repair_parts(RepairedText& text, std::vector<Span>& parts, Repair repair) {
  // The last one first: a repair moves what follows it.
  for (Span& part : std::views::reverse(parts)) {
    const std::uint32_t end = part.end;
    text.set_part(part);
    repair();
    part = text.part();
    const std::uint32_t growth = part.end - end;  // modulo 2^32
    for (Span* later = &part + 1; later != parts.data() + parts.size(); ++later) {
      later->begin += growth;
      later->end += growth;
    }
  }
}

/// What repairs of a text have led to.
struct Repair {
  std::optional<Reading> reading;  ///< of the repaired text; none if nothing was repaired
  DiagnosticSink reports;          ///< of the repairs
};

/// Reads a text with errors again after repairs of its parts: always after those of the spelling,
/// and after those of the structure if fewer errors remain.
Repair repair(const SourceFile& file, std::string_view text, const Reading& first,
              std::vector<Span> parts, const StopRequest* stop) {
  Repair result{.reading = std::nullopt, .reports = DiagnosticSink(stop)};
  RepairedText spelled(text);
  repair_parts(spelled, parts, [&] { repair_spelling({file, spelled, result.reports}); });
  if (spelled.is_changed()) {
    result.reading = read<grammar::file>(file, spelled.text(), &spelled, stop);
    if (result.reading->is_sound() || result.reading->is_foreign) return result;
  }
  const Reading& reading = result.reading ? *result.reading : first;
  const bool has_misplaced = !reading.misplaced.empty();
  if (has_misplaced && first.misplaced.empty()) parts = {whole(spelled.text())};
  RepairedText repaired = spelled;
  DiagnosticSink repairs(stop);
  repair_parts(repaired, parts, [&] {
    repair_structure({file, repaired, repairs}, has_misplaced);
  });
  if (repaired.is_changed()) {
    Reading again = read<grammar::file>(file, repaired.text(), &repaired, stop);
    if (again.sink.error_count() < std::max<std::size_t>(reading.sink.error_count(), 1)) {
      result.reports.add(repairs);
      result.reading = std::move(again);
    }
  }
  return result;
}

/// Whether all errors are in the part of the file.
bool is_sound_outside(const Reading& reading, Span part) {
  const auto is_inside = [&](const Diagnostic& error) {
    const Span where = error.where.span;
    return where.begin >= part.begin && where.end <= part.end;
  };
  return reading.misplaced.empty() && reading.sink.not_kept().empty() &&
         std::ranges::all_of(reading.sink.diagnostics(), is_inside);
}

/// Reads a text with errors again after repairs of the parts with the mistakes.
Reading read_repaired(const SourceFile& file, std::string_view text, Reading first,
                      DiagnosticSink& sink) {
  const StopRequest* stop = sink.stop_request();
  const auto accept = [&](Repair repaired) {
    sink.add(repaired.reports);
    return repaired.reading ? std::move(*repaired.reading) : std::move(first);
  };
  if (first.misplaced.empty()) {
    std::vector<Span> parts = broken_parts(text, first.nodes.span(), first.sink);
    return accept(repair(file, text, first, std::move(parts), stop));
  }
  if (const auto part = misplaced_part(text, first.nodes.span(), first.misplaced, first.sink)) {
    Repair repaired = repair(file, text, first, {*part}, stop);
    if (repaired.reading && is_sound_outside(*repaired.reading, *part)) {
      return accept(std::move(repaired));
    }
  }
  return accept(repair(file, text, first, {whole(text)}, stop));
}

}  // namespace

SyntaxTree parse(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> checked = check_characters(file, sink);
  const std::string_view text = checked ? std::string_view(*checked) : file.text();
  Reading reading = read<grammar::file>(file, text, nullptr, sink.stop_request());
  if (!reading.is_sound() && !reading.is_foreign && text.size() <= kMaxRepairedText) {
    reading = read_repaired(file, text, std::move(reading), sink);
  }
  sink.add(reading.sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

SyntaxTree parse_expression(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> checked = check_characters(file, sink);
  const std::string_view text = checked ? std::string_view(*checked) : file.text();
  Reading reading = read<lone_expression>(file, text, nullptr, sink.stop_request());
  sink.add(reading.sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

}  // namespace sdlc::lang
