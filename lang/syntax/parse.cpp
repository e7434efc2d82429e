#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "lang/syntax/actions.hpp"
#include "lang/syntax/characters.hpp"
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
  bool ends_in_block = false;
};

template <typename Rule>
Reading read(const SourceFile& file, std::string_view text, DiagnosticSink& sink) {
  TreeBuilder builder(file, text, sink);
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf, const char*> in(
      text.data(), text.data() + text.size(), "");
  bool ends_in_block = false;
  builder.push(SyntaxKind::File, {0, 0});
  try {
    pegtl::parse<Rule, Build, Control>(in, builder);
  } catch (const Stopped&) {
  } catch (const Reported&) {
  } catch (const UnclosedBlock&) {
    ends_in_block = true;
  }
  builder.close(0);
  builder.node(0).end = static_cast<std::uint32_t>(text.size());
  return {builder.take_nodes(), builder.take_comments(), ends_in_block};
}

}  // namespace

SyntaxTree parse(const SourceFile& file, DiagnosticSink& sink) {
  // How often a file with unclosed blocks is read anew; each time one more is closed where its
  // indentation says that it ends.
  constexpr int kMaxReadings = 8;

  std::optional<std::string> mended = check_characters(file, sink);
  DiagnosticSink before = sink;
  Reading reading;
  bool is_closed_at_end = false;
  for (int i = 0; i < kMaxReadings; ++i) {
    const std::string_view text = mended ? std::string_view(*mended) : file.text();
    reading = read<grammar::file>(file, text, sink);
    if (!reading.ends_in_block || is_closed_at_end) break;

    const MissingBrace missing = find_missing_brace(text);
    if (i + 1 < kMaxReadings && missing.mend_at) {
      std::string closed(text);
      if (*missing.mend_at == closed.size()) {
        closed.append(missing.count, '}');
        is_closed_at_end = true;
      } else {
        closed[*missing.mend_at] = '}';
      }
      mended = std::move(closed);
      sink = before;
      report_missing_brace(file, missing, sink);
      before = sink;
    } else {
      report_missing_brace(file, missing, sink);
      break;
    }
  }
  const auto size = static_cast<std::uint32_t>(file.text().size());
  if (mended && mended->size() > size) {
    for (SyntaxNode& node : reading.nodes.span()) {
      node.begin = std::min(node.begin, size);
      node.end = std::min(node.end, size);
    }
  }
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

SyntaxTree parse_expression(const SourceFile& file, DiagnosticSink& sink) {
  const std::optional<std::string> mended = check_characters(file, sink);
  const std::string_view text = mended ? std::string_view(*mended) : file.text();
  Reading reading = read<lone_expression>(file, text, sink);
  return {file, std::move(reading.nodes), std::move(reading.comments)};
}

}  // namespace sdlc::lang
