#pragma once

#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"

/// Checks of values against their properties. What fails is reported at `where`; `name` is what the
/// message calls the property, whose name in JSON differs.
namespace sdlc::lang {

/// The limit on whole numbers of properties without Range::NonNegativeExact, which count pixels,
/// samples, rays or threads: they fit an int.
inline constexpr double kMaxWholeNumber = 1e9;

/// Whether the number is in the range.
bool check_range(std::string_view name, Range range, double number, Location where,
                 DiagnosticSink& sink);

/// Whether the number is whole, in the range, and at most kMaxWholeNumber in magnitude (except for
/// NonNegativeExact).
bool check_whole_number(std::string_view name, Range range, double number, Location where,
                        DiagnosticSink& sink);

/// Whether the value has the type and an accepted unit, in any range. Reports nothing.
bool has_type(Type type, const Value& value) noexcept;

/// Whether the value has the type and is in the range. A number without a unit is a length too.
/// Nothing fails silently, since it has been reported. None fails: see check_property().
bool check_value(std::string_view name, Type type, Range range, const Value& value, Location where,
                 DiagnosticSink& sink);

/// The same for a row of a table of properties, which also gives the accepted words and whether
/// `none` is one.
bool check_property(const Property& property, const Value& value, Location where,
                    DiagnosticSink& sink);

}  // namespace sdlc::lang
