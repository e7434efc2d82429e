#pragma once

#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"

/// The writers behind render_diagnostics.
namespace sdlc::lang {

/// "error" or "warning".
std::string_view severity_name(Severity severity) noexcept;

std::string render_human(const DiagnosticSink& sink, bool has_color);
std::string render_json(const DiagnosticSink& sink);

}  // namespace sdlc::lang
