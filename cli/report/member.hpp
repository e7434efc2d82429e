#pragma once

#include <cstdint>
#include <limits>
#include <string_view>

/// Declarations of structs for files. kMembers<T>, a tuple of Member and WriteOnly, lists the
/// fields of T once: JSON is written and read by it, and CSV is derived from JSON.
namespace sdlc::cli {

/// The allowed values of a whole number.
struct Range {
  std::int64_t min = 0, max = std::numeric_limits<int>::max();
};

enum class Presence { Required, Optional };

/// A field that is written and read.
template <typename Access>
struct Member {
  std::string_view name;
  Access access;  ///< T& → V&: a member pointer or a function
  Range range;
  Presence presence;  ///< Optional: earlier versions did not write it

  constexpr Member(std::string_view name_, Access access_, Range range_ = {},
                   Presence presence_ = Presence::Required)
      : name(name_), access(access_), range(range_), presence(presence_) {}
};

/// A field that is only written.
template <typename Access>
struct WriteOnly {
  std::string_view name;
  Access access;  ///< const T& → V

  constexpr WriteOnly(std::string_view name_, Access access_) : name(name_), access(access_) {}
};

template <typename T>
inline constexpr auto kMembers = nullptr;

}  // namespace sdlc::cli
