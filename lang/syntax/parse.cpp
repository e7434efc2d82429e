#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "lang/repair/scene_repair.hpp"
#include "lang/syntax/actions.hpp"
#include "lang/syntax/characters.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/syntax/tree_builder.hpp"

namespace sdlc::lang {
namespace {

/// A text that is one expression and nothing else.
struct lone_expression
    : pegtl::seq<grammar::space, pegtl::must<grammar::property_value, grammar::file_end>> {};

/// What one reading of a text gives.
struct Reading {
  NodeBuffer<SyntaxNode> nodes;
  std::vector<Comment> comments;
  bool has_misplaced = false;
};

/// Counts bytes of the file instead of those of the repaired text.
void move_to_file(Reading& reading, const RepairedText& repaired) {
  for (SyntaxNode& node : reading.nodes.span()) {
    const Span span = repaired.in_source(node.span());
    node.begin = span.begin;
    node.end = span.end;
  }
  for (Comment& comment : reading.comments) comment.span = repaired.in_source(comment.span);
}

template <typename Rule>
Reading read(const SourceFile& file, std::string_view text, const RepairedText* repaired,
             DiagnosticSink& sink) {
  TreeBuilder builder(file, text, repaired, sink);
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf, const char*> in(
      text.data(), text.data() + text.size(), "");
  builder.push(SyntaxKind::File, {0, 0});
  try {
    pegtl::parse<Rule, Build, Control>(in, builder);
  } catch (const Stopped&) {
  } catch (const Reported&) {
  }
  builder.close(0);
  builder.node(0).end = static_cast<std::uint32_t>(text.size());
  Reading reading{builder.take_nodes(), builder.take_comments(), builder.has_misplaced};
  if (repaired != nullptr) move_to_file(reading, *repaired);
  return reading;
}

/// Reads the text after its repair, if that leaves fewer errors than the reading before.
template <typename Rule>
bool read_better(const SourceFile& file, std::string_view text, SceneRepairOptions options,
                 const DiagnosticSink& before, DiagnosticSink& sink, Reading& reading) {
  DiagnosticSink other = before;
  const auto repaired = repair_scene(file, text, options, other);
  if (!repaired) return false;
  const std::size_t reported = other.error_count();
  Reading better = read<Rule>(file, repaired->text(), &*repaired, other);
  const std::size_t still_wrong = other.error_count() - reported;
  const std::size_t was_wrong = sink.error_count() - before.error_count();
  // What is certain may show a mistake that it had hidden.
  const std::size_t allowed =
      options.is_certain ? was_wrong : std::max<std::size_t>(was_wrong, 1) - 1;
  if (still_wrong > allowed) return false;
  sink = std::move(other);
  reading = std::move(better);
  return true;
}

/// Reads the text. If something is wrong with it, reads it again after its repair: of everything,
/// or if that leaves as much wrong as before, of what can have been meant in one way only.
template <typename Rule>
Reading read_repaired(const SourceFile& file, std::string_view text, DiagnosticSink& sink) {
  const DiagnosticSink before = sink;
  Reading reading = read<Rule>(file, text, nullptr, sink);
  const bool is_sound = sink.error_count() == before.error_count() && !reading.has_misplaced;
  if (is_sound) return reading;
  const SceneRepairOptions all{.may_mismatch = reading.has_misplaced}, certain{.is_certain = true};
  if (read_better<Rule>(file, text, all, before, sink, reading)) return reading;
  read_better<Rule>(file, text, certain, before, sink, reading);
  return reading;
}

}  // namespace

SyntaxTree parse(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> checked = check_characters(file, sink);
  const std::string_view text = checked ? std::string_view(*checked) : file.text();
  Reading reading = read_repaired<grammar::file>(file, text, sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

SyntaxTree parse_expression(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> checked = check_characters(file, sink);
  const std::string_view text = checked ? std::string_view(*checked) : file.text();
  Reading reading = read<lone_expression>(file, text, nullptr, sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

}  // namespace sdlc::lang
