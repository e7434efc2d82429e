#pragma once

#include <memory>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/table.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// Reads a data file of one of the formats in kDataFormats. Reports mistakes, up to some hundreds;
/// null if there are any. Linear in the size of the text.
std::shared_ptr<const Table> read_table(const SourceFile& file, DiagnosticSink& sink);

}  // namespace sdlc::lang
