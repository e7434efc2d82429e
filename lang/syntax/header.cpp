#include <span>
#include <string>

#include <fmt/format.h>

#include "lang/syntax/tree_builder.hpp"
#include "lang/text/ascii.hpp"
#include "lang/text/nearest_name.hpp"
#include "lang/token/lines.hpp"
#include "lang/token/name_characters.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

constexpr std::string_view kScene = "scene";

/// The beginning of a line `scene N` after other statements; npos if there is none.
std::size_t find_version(std::string_view text, std::uint32_t from) {
  for (std::size_t at = text.find("scene ", from); at != std::string_view::npos;
       at = text.find("scene ", at + 1)) {
    const auto begin = static_cast<std::uint32_t>(at);
    const std::uint32_t number = skip_blanks(text, begin + 5);
    if (is_first_of_line(text, begin) && is_digit(char_at(text, number))) return at;
  }
  return std::string_view::npos;
}

/// Whether the word differs from `scene` by one letter only.
bool resembles_scene(std::string_view word) {
  return word.size() > 3 && nearest_name(word, std::span(&kScene, 1)).has_value();
}

/// Where the documentation of the statement at `at` begins; `at` if it has none.
std::uint32_t begin_of_documentation(std::string_view text, std::uint32_t at) {
  TokenReader reader(text);
  for (Token token = reader.next(); token.span.begin < at; token = reader.next()) {
    if (token.kind == TokenKind::DocComment) return token.span.begin;
  }
  return at;
}

/// Whether a JSON object begins at `at`.
bool is_json_object(std::string_view text, std::uint32_t at) {
  if (char_at(text, at) != '{') return false;
  const char next = char_at(text, skip_space(text, at + 1));
  return next == '"' || next == '}';
}

}  // namespace

std::uint32_t diagnose_header(TreeBuilder& builder, std::uint32_t at) {
  const std::string_view text = builder.text();
  if (is_json_object(text, at)) {
    builder.sink()
        .report(diag::missing_version, builder.location({at, at + 1}))
        .help("this is JSON; the name of a JSON config ends in `.json`");
    builder.is_foreign = true;
    throw ParseAbandoned{};
  }
  const Span found = token_at(text, at);
  const std::string_view word = text.substr(found.begin, found.size());
  const std::uint32_t next = skip_blanks(text, found.end);
  const bool has_number = is_digit(char_at(text, next));
  const auto missing = [&](Span span) {
    return builder.sink()
        .report(diag::missing_version, builder.location(span))
        .help("the first statement is `scene 1`");
  };

  if (word != kScene) {
    const std::string small = lower_case(word);
    const bool differs_by_case = small == kScene;
    if (word == "scene1") {
      missing(found).fix(builder.location(found), "scene 1");
      return skip_space(text, found.end);
    }
    if (has_number && (differs_by_case || resembles_scene(small))) {
      auto report = builder.sink().report(diag::expected, builder.location(found),
                                          fmt::format("`scene`, found `{}`", word));
      if (differs_by_case) report.fix(builder.location(found), std::string(kScene));
      if (!differs_by_case) report.suggest(kScene);
      return skip_space(text, token_at(text, next).end);
    }
    const std::size_t version = find_version(text, at);
    if (version == std::string_view::npos) {
      const std::uint32_t first = begin_of_documentation(text, at);
      missing(found).fix(builder.location({first, first}), "scene 1\n");
      return at;
    }
    const auto begin = static_cast<std::uint32_t>(version);
    const std::uint32_t end = token_at(text, skip_blanks(text, begin + 5)).end;
    const Location later = builder.location({begin, end});
    builder.sink()
        .report(diag::missing_version, builder.location(found))
        .label(later, "this must be the first statement")
        .help(
            fmt::format("move `{}` to the beginning of the file", text.substr(begin, end - begin)))
        .unsafe_fix(builder.location({at, at}),
                    fmt::format("{}\n", text.substr(begin, end - begin)))
        .unsafe_fix(later, "");
    return at;
  }

  // `scene` without a number, or with one that is no version.
  const std::uint32_t version = skip_space(text, found.end);
  std::uint32_t end = version;
  while (is_idchar(char_at(text, end)) || char_at(text, end) == '.') ++end;
  if (end > version && text[version] == '1' && is_letter(char_at(text, version + 1))) {
    const std::uint32_t gap = version + 1;
    builder.sink()
        .report(diag::expected, builder.location({gap, gap}),
                fmt::format("a new line after `scene 1`, found `{}`", text.substr(gap, end - gap)))
        .unsafe_fix(builder.location({gap, gap}), "\n");
    return gap;
  }
  if (end > version && is_digit(text[version])) {
    const Location where = builder.location({version, end});
    builder.sink().report(diag::unsupported_version, where, text.substr(version, end - version));
    return skip_space(text, end);
  }
  const char mark = char_at(text, next);
  const std::uint32_t number = skip_blanks(text, next + 1);
  if ((mark == ':' || mark == '=') && is_digit(char_at(text, number))) {
    const Span all{found.begin, token_at(text, number).end};
    auto report = missing(all);
    if (text.substr(number, all.end - number) == "1") report.fix(builder.location(all), "scene 1");
    return skip_space(text, all.end);
  }
  auto report = missing(found);
  const bool is_alone = mark == '\0' || mark == '\n' || mark == '\r' || mark == '/';
  if (is_alone) report.fix(builder.location(found), "scene 1");
  return skip_space(text, found.end);
}

}  // namespace sdlc::lang
