#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/syntax/syntax.hpp"
#include "lang/workspace/document.hpp"

/// The one layout of scenes, as docs/format.md describes it.
namespace sdlc::lang {

/// Columns of a line, where the text can be broken at all.
inline constexpr std::uint32_t kFormatWidth = 100;
/// Columns that what is inside brackets stands further to the right.
inline constexpr std::uint32_t kFormatIndent = 2;

/// Lines of a text, counted from 1, both ends included.
struct LineRange {
  std::uint32_t first = 1;
  std::uint32_t last = 1;
};

/// The text of the tree, formatted. Precondition: the text was parsed without errors.
std::string format(const SyntaxTree& tree);

/// The same, of those statements only that touch the lines; the other bytes are as they were.
std::string format_lines(const SyntaxTree& tree, LineRange lines);

/// Whether two texts that were parsed without errors say the same: the same tokens, but for commas
/// that need not be there and the 0 in front of a number's point, in the same structure, with the
/// same comments between the same tokens, but for commas and operators.
bool is_same_program(const SyntaxTree& a, const SyntaxTree& b);

/// Formats all of a file, or `lines` of it. What is wrong with it is reported; nothing comes of a
/// file with errors. Throws std::logic_error if the outcome does not say the same as the file: a
/// defect of the formatter.
std::optional<std::string> format_file(const Document& file, DiagnosticSink& sink,
                                       std::optional<LineRange> lines = std::nullopt);

}  // namespace sdlc::lang
