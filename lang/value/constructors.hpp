#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"

namespace sdlc::lang {

/// The largest number of arguments that a constructor has.
inline constexpr std::size_t kMaxArguments = 3;

/// The arguments of a constructor, by parameter: each of its type and in its range, written or by
/// default.
using ConstructorArguments = std::array<Value, kMaxArguments>;

/// A function that makes a colour, a material or a motion. Its parameters have names and are
/// described like properties.
struct Constructor {
  std::string_view name;
  std::span<const Property> parameters;
  std::string_view doc;
  Value (*construct)(const Constructor& constructor, const ConstructorArguments& arguments);
  /// Steps that it takes: see limits.hpp.
  std::uint64_t (*steps)(const ConstructorArguments& arguments) = [](const auto&) {
    return std::uint64_t{4};
  };

  std::size_t index() const noexcept;  ///< in all_constructors()
};

std::span<const Constructor> all_constructors() noexcept;
const Constructor* find_constructor(std::string_view name) noexcept;

/// The default of a parameter; Nothing if it has none.
Value default_of(const Property& parameter);

}  // namespace sdlc::lang
