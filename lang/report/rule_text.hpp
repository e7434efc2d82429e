#pragma once

#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"

/// Descriptions of a rule in reports, from its name and the page that explains it.
namespace sdlc::lang {

/// "UnknownProperty"
std::string pascal_name(const DiagnosticInfo& info);
/// "Unknown property"
std::string rule_title(const DiagnosticInfo& info);

/// The first paragraph of the page as one line, without links and backticks.
std::string first_paragraph(std::string_view page);
/// The page without its title, and with links to other pages replaced by their text, because the
/// other pages are not in the report.
std::string page_for_elsewhere(std::string_view page);

}  // namespace sdlc::lang
