#pragma once

#include <cstdint>
#include <string>

#include "lang/diagnostics/diagnostics.hpp"

namespace sdlc::lang {

enum class MessageFormat : std::uint8_t { Human, Concise, Json };

struct RenderDiagnosticsOptions {
  MessageFormat format = MessageFormat::Human;
  bool color = false;  ///< ANSI colours; only the human format has any
};

/// "file:line:column" of where the span begins, as it may be printed.
std::string describe_place(const Location& where);

/// The sink's diagnostics as text, by place. Human shows the source line with carets under the
/// span, labels, help and a closing count; Concise is one line each, `file:line:col:
/// severity[CODE]: message`, then
/// `; did you mean X?` where there is a suggestion; Json is one object with an array `diagnostics`.
std::string render_diagnostics(const DiagnosticSink& sink, const RenderDiagnosticsOptions& options);

}  // namespace sdlc::lang
