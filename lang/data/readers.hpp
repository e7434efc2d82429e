#pragma once

#include <memory>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/table.hpp"
#include "lang/source/source.hpp"

/// A reader per format; each is read_table() for its format.
namespace sdlc::lang {

/// CSV (RFC 4180) and, with a tab as separator, TSV.
std::shared_ptr<const Table> read_delimited(const SourceFile& file, char separator,
                                            DiagnosticSink& sink);
/// XYZ: the number of atoms, a comment line, then a line `element x y z …` per atom.
std::shared_ptr<const Table> read_xyz(const SourceFile& file, DiagnosticSink& sink);

/// The text from `at` to the end of the line, without the line end; `at` moves to the next line.
std::string_view take_line(std::string_view text, std::uint32_t& at);
/// The offset of the first byte after a byte order mark.
std::uint32_t begin_of_text(std::string_view text);

}  // namespace sdlc::lang
