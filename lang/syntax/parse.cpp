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
  bool has_misplaced = false, is_foreign = false;

  bool is_sound() const { return !sink.has_errors() && !has_misplaced; }
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
                  builder.has_misplaced, builder.is_foreign};
  if (repaired != nullptr) move_to_file(reading, file, *repaired);
  return reading;
}

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

/// Reads a text with errors again after repairs: always after those of the spelling, and after
/// those of the structure if fewer errors remain.
Reading read_repaired(const SourceFile& file, std::string_view text, Reading reading,
                      DiagnosticSink& sink) {
  const StopRequest* stop = sink.stop_request();
  std::vector<Span> parts = {{0, static_cast<std::uint32_t>(text.size())}};
  if (!reading.has_misplaced) parts = broken_parts(text, reading.nodes.span(), reading.sink);
  RepairedText spelled(text);
  repair_parts(spelled, parts, [&] { repair_spelling({file, spelled, sink}); });
  if (spelled.is_changed()) {
    reading = read<grammar::file>(file, spelled.text(), &spelled, stop);
    if (reading.is_sound() || reading.is_foreign) return reading;
  }
  if (reading.has_misplaced) parts = {{0, static_cast<std::uint32_t>(spelled.text().size())}};
  RepairedText repaired = spelled;
  DiagnosticSink repairs(stop);
  repair_parts(repaired, parts, [&] {
    repair_structure({file, repaired, repairs}, reading.has_misplaced);
  });
  if (repaired.is_changed()) {
    Reading again = read<grammar::file>(file, repaired.text(), &repaired, stop);
    if (again.sink.error_count() < std::max<std::size_t>(reading.sink.error_count(), 1)) {
      sink.add(repairs);
      return again;
    }
  }
  return reading;
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
