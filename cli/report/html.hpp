#pragma once

#include <string>
#include <string_view>

/// Text as HTML. The page is also valid XML: every element is closed, so that a test can check that
/// tags match.
namespace sdlc::cli {

/// Escapes text for element content and attribute values: HTML special characters become entities,
/// control characters become visible symbols, invalid UTF-8 becomes U+FFFD.
std::string escaped(std::string_view text);

/// The text of HTML for a terminal: without tags, entities and no-break spaces.
std::string plain_text(std::string_view html);

/// RFC 4648, section 4, with padding.
std::string base64(std::string_view bytes);

}  // namespace sdlc::cli
