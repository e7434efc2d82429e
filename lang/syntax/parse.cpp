#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "lang/syntax/actions.hpp"
#include "lang/syntax/characters.hpp"
#include "lang/syntax/mending.hpp"
#include "lang/syntax/recovery.hpp"
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

/// Counts bytes of the file instead of those of the mended text.
void move_to_file(Reading& reading, const MendedText& mending) {
  const auto move = [&](auto& span) {
    span.begin = mending.in_source(span.begin);
    span.end = mending.in_source(span.end);
  };
  for (SyntaxNode& node : reading.nodes.span()) move(node);
  for (Comment& comment : reading.comments) move(comment.span);
}

template <typename Rule>
Reading read(const SourceFile& file, std::string_view text, const MendedText* mending,
             DiagnosticSink& sink) {
  TreeBuilder builder(file, text, mending, sink);
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
  if (mending != nullptr) move_to_file(reading, *mending);
  return reading;
}

/// Reads the text as `mending` has it, if that leaves less wrong than the reading before.
template <typename Rule>
bool read_better(const SourceFile& file, std::string_view text, MendOptions options,
                 const DiagnosticSink& before, DiagnosticSink& sink, Reading& reading) {
  DiagnosticSink other = before;
  const auto mending = mend(file, text, options, other);
  if (!mending) return false;
  const std::size_t told = other.error_count();
  Reading mended = read<Rule>(file, mending->text(), &*mending, other);
  const std::size_t still_wrong = other.error_count() - told;
  const std::size_t was_wrong = sink.error_count() - before.error_count();
  // What is certain may show a mistake that it had hidden.
  const std::size_t allowed =
      options.is_certain ? was_wrong : std::max<std::size_t>(was_wrong, 1) - 1;
  if (still_wrong > allowed) return false;
  sink = std::move(other);
  reading = std::move(mended);
  return true;
}

/// Reads the text, and if something is wrong with it, once more as it is mended: as a whole, or if
/// that leaves as much wrong as before, where no one can doubt what was meant.
template <typename Rule>
Reading read_mended(const SourceFile& file, std::string_view text, DiagnosticSink& sink) {
  const DiagnosticSink before = sink;
  Reading reading = read<Rule>(file, text, nullptr, sink);
  const bool is_sound = sink.error_count() == before.error_count() && !reading.has_misplaced;
  if (is_sound) return reading;
  const MendOptions whole{.may_mismatch = reading.has_misplaced}, certain{.is_certain = true};
  if (read_better<Rule>(file, text, whole, before, sink, reading)) return reading;
  read_better<Rule>(file, text, certain, before, sink, reading);
  return reading;
}

}  // namespace

SyntaxTree parse(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> checked = check_characters(file, sink);
  const std::string_view text = checked ? std::string_view(*checked) : file.text();
  Reading reading = read_mended<grammar::file>(file, text, sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

SyntaxTree parse_expression(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> checked = check_characters(file, sink);
  const std::string_view text = checked ? std::string_view(*checked) : file.text();
  Reading reading = read<lone_expression>(file, text, nullptr, sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

}  // namespace sdlc::lang
