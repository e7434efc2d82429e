#pragma once

#include <string>
#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"

/// What reports say of a diagnostic as such, made from its name and the page that explains it.
namespace sdlc::lang {

/// "UnknownProperty"
std::string pascal_name(const DiagnosticInfo& info);
/// "Unknown property"
std::string rule_title(const DiagnosticInfo& info);

/// The page's first paragraph as one line, links and backticks taken off.
std::string first_paragraph(std::string_view page);
/// The page without its title, and with the text of a link in place of the link where that leads to
/// another page: a report is read elsewhere.
std::string page_for_elsewhere(std::string_view page);

}  // namespace sdlc::lang
