#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "lang/ast/ast.hpp"
#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/source/limits.hpp"
#include "lang/source/source.hpp"

namespace sdlc::lang {

/// The value of a Number node: the nearest double, multiplied or divided once for its unit. A
/// number that is too large is reported; the result is then Nothing.
Value evaluate_number(ast::Node node, DiagnosticSink& sink);
/// The double nearest to a decimal number without sign and unit, which may have an exponent and `_`
/// between digits. nullopt if it is beyond the largest.
std::optional<double> parse_decimal(std::string_view digits);
/// The value of a String node. An unpaired surrogate is reported; the result is then Nothing.
Value evaluate_string(ast::Node node, DiagnosticSink& sink);

/// Whether a string may be this long; if not, that is reported at `where`.
bool check_string_size(std::uint64_t bytes, const Limits& limits, Location where,
                       DiagnosticSink& sink);

}  // namespace sdlc::lang
