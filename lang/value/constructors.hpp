#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// The largest number of arguments that a constructor has.
inline constexpr std::size_t kMaxArguments = 3;

/// The checked arguments of a constructor by parameter, with defaults filled in.
using ConstructorArguments = std::array<Value, kMaxArguments>;

/// A built-in function with named parameters, which makes a colour, a material or a motion.
struct Constructor {
  std::string_view name;
  std::span<const Property> parameters;
  std::string_view doc;
  Value (*construct)(const Constructor& constructor, const ConstructorArguments& arguments);
  /// Steps of a call: see limits.hpp.
  std::uint64_t (*steps)(const ConstructorArguments& arguments) = [](const auto&) {
    return std::uint64_t{4};
  };

  std::size_t index() const noexcept;  ///< in all_constructors()
};

std::span<const Constructor> all_constructors() noexcept;
const Constructor* find_constructor(std::string_view name) noexcept;

/// As the reference shows it: "specular(color, fuzz: 0)".
std::string signature_of(const Constructor& constructor);
/// The type of the result, as in types.hpp; empty: a motion, which no parameter can have.
std::string_view result_of(const Constructor& constructor) noexcept;

/// The default of a parameter; Nothing if it has none.
Value default_of(const Property& parameter);

}  // namespace sdlc::lang
