#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "lang/editor/text_edits.hpp"
#include "lang/source/source.hpp"
#include "lang/workspace/document.hpp"

/// Formatting of open texts. There is one layout (docs/format.md), so the options of editors, such
/// as the size of a tab, have no effect. Line ends and a byte order mark belong to the editor and
/// are kept; new lines end like the first line of the text.
namespace sdlc::lang {

/// The result of formatting a text.
struct Formatting {
  std::vector<TextEdit> edits = {};  ///< none if nothing changes or the request is refused
  std::string refusal = {};          ///< why the text cannot be formatted: a sentence; often empty
  Span cause = {};                   ///< of the refusal, such as the first syntax error

  bool is_refused() const noexcept { return !refusal.empty(); }
};

/// Formats all of the text. Refused if the text has syntax errors or is a JSON config. Throws
/// std::logic_error if the result would be another program: a defect of the formatter.
Formatting format_text(const Document& file);

/// Formats the statements that touch the lines of `range`, and nothing else. A range that ends at
/// the beginning of a line does not touch that line.
Formatting format_range(const Document& file, Span range);

/// Characters after which an editor asks for format_on_type(). Others, such as `)` and `,`, are
/// typed within a statement, whose text must not move yet.
inline constexpr std::array<std::string_view, 2> kFormattingTriggers{"}", "\n"};

/// Formats the statement that was just finished: after `}` the one that this brace closes, after a
/// line end the one that ends on the line before it, unless it ends with a brace. `caret`: the
/// offset after the typed text and the indentation that the editor may have added. No edit is
/// outside the statement or after the caret; if the layout cannot be reached in this way, there is
/// none. Refused as format_text() is, which is not worth a message here.
Formatting format_on_type(const Document& file, std::uint32_t caret, std::string_view typed);

}  // namespace sdlc::lang
