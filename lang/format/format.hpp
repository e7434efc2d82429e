#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/workspace/document.hpp"

/// The one layout of scenes, as docs/format.md describes it.
namespace sdlc::lang {

/// Maximum columns of a line, unless the text cannot be broken.
inline constexpr std::uint32_t kFormatWidth = 100;
/// Columns per level of indentation.
inline constexpr std::uint32_t kFormatIndent = 2;

/// Lines of a text, from 1, including both ends.
struct LineRange {
  std::uint32_t first = 1;
  std::uint32_t last = 1;
};

/// The text of the tree, formatted. Precondition: the text was parsed without errors.
std::string format(const SyntaxTree& tree);

/// Formats only the statements that touch the lines; the other bytes are unchanged.
std::string format_lines(const SyntaxTree& tree, LineRange lines);

/// Whether two texts are the same program: equal trees and tokens, except optional commas and the 0
/// before a decimal point, with the same comments between the same tokens, except commas and
/// operators. Precondition: both were parsed without errors.
bool is_same_program(const SyntaxTree& a, const SyntaxTree& b);

/// Formats a file, or `lines` of it. Reports its syntax errors; nullopt if there are any. Throws
/// std::logic_error if the result is another program: a defect of the formatter.
std::optional<std::string> format_file(const Document& file, DiagnosticSink& sink,
                                       std::optional<LineRange> lines = std::nullopt);

}  // namespace sdlc::lang
