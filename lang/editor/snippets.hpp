#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lang/schema/schema.hpp"

/// Templates of statements, in the snippet syntax of the Language Server Protocol: `${1:name}`.
namespace sdlc::lang {

enum class SnippetPlace : std::uint8_t {
  EmptyFile,
  TopLevel,   ///< only there
  Statement,  ///< wherever objects may be
};

struct Snippet {
  std::string_view name;  ///< of a keyword: the keyword
  std::string_view doc;
  std::string_view body;
  SnippetPlace place;
  bool is_keyword = false;
};

/// Statements with a keyword, and templates of several statements.
std::span<const Snippet> all_snippets() noexcept;

/// An object of the kind with its required properties.
std::string snippet_of(const Kind& kind);
/// `label: ` and the value.
std::string snippet_of(const Property& property);
/// A value of the property's type. Placeholders are numbered from `next` on, which is moved.
std::string placeholder_of(const Property& property, int& next);

}  // namespace sdlc::lang
