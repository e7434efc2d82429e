#pragma once

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "tests/lang/token/tokenize.hpp"

namespace sdlc::test {

inline std::string_view name_of(lang::TokenKind kind) {
  constexpr std::string_view kNames[] = {"space",       "line end", "comment", "doc",    "block",
                                         "open block",  "name",     "foreign", "number", "string",
                                         "open string", "color",    "open",    "close",  "mark",
                                         "unknown",     "end"};
  return kNames[static_cast<std::size_t>(kind)];
}

/// The tokens of a text without its spaces, as `kind:text`.
inline std::string spelled(std::string_view text, lang::SourceFormat format) {
  std::string result;
  for (const lang::Token& token : tokenize(text, format)) {
    if (token.kind == lang::TokenKind::Space) continue;
    const auto written = text.substr(token.span.begin, token.span.size());
    result += fmt::format("{}{}:{}", result.empty() ? "" : " ", name_of(token.kind), written);
  }
  return result;
}

}  // namespace sdlc::test
