#include "lang/json/parser.hpp"

#include <algorithm>
#include <optional>

#include <tao/pegtl/memory_input.hpp>
#include <tao/pegtl/normal.hpp>
#include <tao/pegtl/nothing.hpp>
#include <tao/pegtl/parse.hpp>

#include "grammar/json.hpp"
#include "lang/json/deviations.hpp"
#include "lang/json/parsed_text.hpp"
#include "lang/json/tape_builder.hpp"
#include "lang/repair/json_repair.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {
namespace {

namespace grammar = grammar::json;
namespace pegtl = tao::pegtl;

/// The state of the actions.
struct Parser {
  Parser(const ParsedText& parsed, ConfigParts& parts, DiagnosticSink& sink)
      : text(parsed.text()), tape(parsed, parts, sink), deviations(parsed, tape, sink) {}

  std::string_view text;
  TapeBuilder tape;
  Deviations deviations;
  Span opening_comment = {};
};

template <typename Rule>
struct Action : pegtl::nothing<Rule> {};

/// The action of a rule. `span` is the matched text.
#define SDLC_JSON_ACTION(rule, statement)                                             \
  template <>                                                                         \
  struct Action<grammar::rule> {                                                      \
    template <typename Input>                                                         \
    static void apply(const Input& in, [[maybe_unused]] Parser& parser) {             \
      const char* text = parser.text.data();                                          \
      [[maybe_unused]] const Span span{static_cast<std::uint32_t>(in.begin() - text), \
                                       static_cast<std::uint32_t>(in.end() - text)};  \
      statement;                                                                      \
    }                                                                                 \
  };

SDLC_JSON_ACTION(begin_array, parser.tape.open(JsonNodeType::Array, span))
SDLC_JSON_ACTION(begin_object, parser.tape.open(JsonNodeType::Object, span))
SDLC_JSON_ACTION(end_array, parser.tape.close(span.end))
SDLC_JSON_ACTION(end_object, parser.tape.close(span.end))
SDLC_JSON_ACTION(value_separator, parser.deviations.note_separator(span.begin))
SDLC_JSON_ACTION(present_element, parser.tape.end_element())
SDLC_JSON_ACTION(present_member, parser.tape.end_member())

SDLC_JSON_ACTION(number, parser.tape.add_number(span, {in.begin(), in.size()}))
SDLC_JSON_ACTION(false_, parser.tape.add(JsonNodeType::Bool, span))
SDLC_JSON_ACTION(true_, parser.tape.add(JsonNodeType::Bool, span).number = 1)
SDLC_JSON_ACTION(null, parser.tape.add(JsonNodeType::Null, span))
SDLC_JSON_ACTION(opening_quote, parser.tape.begin_string(span))
SDLC_JSON_ACTION(opening_single_quote, parser.tape.begin_string(span))
SDLC_JSON_ACTION(opening_curly_quote, parser.tape.begin_string(span))
SDLC_JSON_ACTION(escape, parser.tape.note_escape())
SDLC_JSON_ACTION(string, parser.tape.add_string(span))
SDLC_JSON_ACTION(opening_comment, parser.opening_comment = span)

SDLC_JSON_ACTION(single_quoted, parser.deviations.quoted(span, "single quotes are"))
SDLC_JSON_ACTION(curly_quoted, parser.deviations.quoted(span, "curly quotes are"))
SDLC_JSON_ACTION(line_comment, parser.deviations.comment(span))
SDLC_JSON_ACTION(block_comment, parser.deviations.comment(span))
SDLC_JSON_ACTION(foreign_blank, parser.deviations.foreign_blank(span))
SDLC_JSON_ACTION(malformed_number, parser.deviations.malformed_number(span))
SDLC_JSON_ACTION(word, parser.deviations.word(span))
SDLC_JSON_ACTION(bare_name, parser.deviations.bare_name(span))
SDLC_JSON_ACTION(lone_surrogate, parser.deviations.bad_escape(span, "half a surrogate pair `{}`"))
SDLC_JSON_ACTION(short_escape,
                 parser.deviations.bad_escape(span, "`{}` without four hexadecimal digits"))
SDLC_JSON_ACTION(unknown_escape, parser.deviations.unknown_escape(span))
SDLC_JSON_ACTION(raw_control, parser.deviations.raw_control(span))
SDLC_JSON_ACTION(invalid_utf8, parser.deviations.invalid_utf8(span))
SDLC_JSON_ACTION(trailing_separator, parser.deviations.trailing_separator())
SDLC_JSON_ACTION(missing_value_separator, parser.deviations.missing_value_separator(span.begin))
SDLC_JSON_ACTION(missing_name_separator, parser.deviations.missing_name_separator(span.begin))
SDLC_JSON_ACTION(equals_sign, parser.deviations.equals_sign(span))
SDLC_JSON_ACTION(missing_element, parser.deviations.missing_value(span.begin))
SDLC_JSON_ACTION(missing_value, parser.deviations.missing_value(span.begin))
SDLC_JSON_ACTION(missing_member, parser.deviations.missing_member(span.begin))
SDLC_JSON_ACTION(repaired_value, parser.deviations.repaired_value(span))
SDLC_JSON_ACTION(repaired_name, parser.deviations.repaired_name(span))
SDLC_JSON_ACTION(repaired_member, parser.deviations.repaired_member(span))

#undef SDLC_JSON_ACTION

// Errors of `must`: the text that the rule expects. A rule without one does not compile.

template <typename Rule>
struct Expected;

#define SDLC_JSON_EXPECTED(rule, words)          \
  template <>                                    \
  struct Expected<grammar::rule> {               \
    static constexpr const char* kWords = words; \
  };

SDLC_JSON_EXPECTED(object, "an object { … }")
SDLC_JSON_EXPECTED(first_member, "a key in double quotes or `}`")
SDLC_JSON_EXPECTED(member, "a key in double quotes")
SDLC_JSON_EXPECTED(present_member, "a key in double quotes")
SDLC_JSON_EXPECTED(name_separation, "`:`")
SDLC_JSON_EXPECTED(member_value, "a value")
SDLC_JSON_EXPECTED(end_object, "`,` or `}`")
SDLC_JSON_EXPECTED(first_element, "a value or `]`")
SDLC_JSON_EXPECTED(element, "a value")
SDLC_JSON_EXPECTED(present_element, "a value")
SDLC_JSON_EXPECTED(end_array, "`,` or `]`")

#undef SDLC_JSON_EXPECTED

template <typename Rule, typename... Rules>
constexpr bool kIsOneOf = (std::is_same_v<Rule, Rules> || ...);

template <typename Rule>
struct Control : pegtl::normal<Rule> {
  template <typename Input>
  [[noreturn]] static void raise(const Input& in, Parser& parser) {
    const auto offset = static_cast<std::uint32_t>(in.current() - parser.text.data());
    if constexpr (kIsOneOf<Rule, grammar::closing_quote, grammar::closing_single_quote,
                           grammar::closing_curly_quote>) {
      parser.deviations.unclosed_string();
    } else if constexpr (std::is_same_v<Rule, grammar::block_comment_rest>) {
      parser.deviations.unclosed_comment(parser.opening_comment);
    } else if constexpr (std::is_same_v<Rule, pegtl::eof>) {
      parser.deviations.text_after_config(offset);
    } else {
      parser.deviations.expected(Expected<Rule>::kWords, offset);
    }
  }
};

}  // namespace

std::string_view streamed_key() noexcept {
  return std::ranges::find(json_config().keys, JsonType::Spheres, &JsonKey::type)->key;
}

bool parse_config(const SourceFile& file, ConfigParts& parts, DiagnosticSink& sink) {
  if (file.text().starts_with("scene ")) {
    sink.report(diag::expected, {&file, {0, 5}}, "an object { … }")
        .help("this is a scene text; the name of a scene file ends in `.scene`");
    return false;
  }
  const std::optional<RepairedText> repaired = repair_json(file, sink);
  const ParsedText text(file, repaired);
  Parser parser(text, parts, sink);
  pegtl::memory_input<pegtl::tracking_mode::lazy, pegtl::eol::lf_crlf, const char*> in(
      parser.text.data(), parser.text.data() + parser.text.size(), file.name().c_str());
  try {
    return pegtl::parse<grammar::text, Action, Control>(in, parser) && parser.tape.is_complete();
  } catch (const JsonAbandoned&) {
    parser.tape.give_up();
    return false;
  }
}

}  // namespace sdlc::lang
