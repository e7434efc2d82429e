#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Spellings that are not JSON and their probable meaning.
namespace sdlc::lang {

struct NearNumber {
  std::string_view reason;          ///< why the text is not a JSON number
  std::optional<std::string> text;  ///< the intended number in JSON
  bool is_certain = true;
};

/// Precondition: `text` is not a JSON number.
NearNumber near_number(std::string_view text);

/// "true", "false" or "null" for words such as True, None, undefined, yes, off; else nullopt.
std::optional<std::string_view> near_literal(std::string_view word);

/// Whether the word, with or without a sign, is NaN, Infinity or inf.
bool is_non_finite(std::string_view word);

/// The content of a string with other quotes as a JSON string.
std::string quote_for_json(std::string_view content);

}  // namespace sdlc::lang
