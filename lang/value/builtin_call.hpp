#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "lang/object/object.hpp"
#include "lang/value/builtins.hpp"

/// What the built-in functions share: arguments, and results that do not exist.
namespace sdlc::lang {

inline constexpr std::string_view kAngleWanted = "an angle", kListWanted = "a list";

template <typename T>
const T* argument(const BuiltinCall& call, std::size_t i) noexcept {
  return get_if<T>(&call.arguments[i]);
}

/// The argument if it is a number without a unit.
inline const Scalar* plain_number(const BuiltinCall& call, std::size_t i) noexcept {
  const auto* x = argument<Scalar>(call, i);
  return x != nullptr && x->unit == Unit::None ? x : nullptr;
}

/// Reports that the argument has the wrong type; `wanted`: "a number". The result is Nothing.
Value wrong_argument(const BuiltinCall& call, std::size_t i, std::string_view wanted);
/// Reports that there is no result for `argument`: "a negative number". The result is Nothing.
Value no_result(const BuiltinCall& call, std::string_view argument);
/// Where the number or angle `x` is between the arguments `low` and the next one: 0 at the first, 1
/// at the second, not limited. `low` counts from argument 0. nullopt: that is reported.
std::optional<double> share_of_interval(const BuiltinCall& call, std::size_t x, std::size_t low);
/// The result if it is finite; else an overflow is reported.
Value finite(const BuiltinCall& call, Value result);

}  // namespace sdlc::lang
