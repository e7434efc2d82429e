#pragma once

#include <string_view>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"

/// Whether values fit the properties that they are given to.
namespace sdlc::lang {

/// The largest whole number of a property without Range::NonNegativeExact: such values count
/// pixels, samples, rays and threads, and fit an int.
inline constexpr double kMaxWholeNumber = 1e9;

/// Whether the number is in the range; if not, that is reported at `where` under the name `name`.
bool check_range(std::string_view name, Range range, double number, Location where,
                 DiagnosticSink& sink);

/// Whether the number is whole, in the range and at most kMaxWholeNumber (but for
/// NonNegativeExact); what is wrong is reported.
bool check_whole_number(std::string_view name, Range range, double number, Location where,
                        DiagnosticSink& sink);

/// Whether the value is of the type, and its unit one that the type takes; its range aside.
bool has_type(Type type, const Value& value) noexcept;

/// Whether `value` has the property's type and is in its range; what is wrong is reported at
/// `where` under the name `name` (the JSON format has other names). A number serves as a length, a
/// whole number must be whole. Nothing is wrong silently: it has been reported. None is never
/// right here: see check_property.
bool check_value(std::string_view name, Type type, Range range, const Value& value, Location where,
                 DiagnosticSink& sink);

/// The same by the property's row in its table, which also says whether `none` is a value and which
/// words are.
bool check_property(const Property& property, const Value& value, Location where,
                    DiagnosticSink& sink);

}  // namespace sdlc::lang
