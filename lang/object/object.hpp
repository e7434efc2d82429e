#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "lang/diagnostics/diagnostics.hpp"
#include "lang/object/value.hpp"
#include "lang/schema/schema.hpp"
#include "lang/source/source.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

/// Checked objects, the common form of both formats: every value has the type and range of its
/// property, and its place in the text.
namespace sdlc::lang {

/// The value of one property of an object.
struct Slot {
  Value value;
  Span span;                ///< of the value, in the object's file
  bool is_written = false;  ///< true for wrong values too
};

/// The value of a property at the closing of the shutter.
struct ClosingValue {
  std::size_t property;
  Value value;
};

/// An object whose properties have been checked one by one. `slots` has an entry per property, in
/// the order of the kind's table.
struct Object {
  const Kind* kind = nullptr;
  Location where;          ///< of the kind's name, or of the first character of a JSON object
  std::string name;        ///< `main` in `camera main`; empty if there is none
  bool is_broken = false;  ///< a part could not be read: do not report missing properties
  std::array<Slot, kMaxProperties> slots;
  /// Values that change while the shutter is open, at its closing; `slots` has those at the
  /// opening. Only centres of spheres and translations and rotations of groups change.
  std::vector<ClosingValue> closing;

  const Slot& slot(std::size_t property) const { return slots[property]; }
  Location location(std::size_t property) const { return {where.file, slots[property].span}; }

  /// The written value, else the default of the table; nullopt if it is no T.
  template <typename T>
  std::optional<T> get(std::size_t property) const;
  /// The same at the closing of the shutter.
  template <typename T>
  std::optional<T> get_closing(std::size_t property) const {
    for (const ClosingValue& changed : closing) {
      if (changed.property == property) return value_as<T>(changed.value);
    }
    return get<T>(property);
  }
};

/// Receives checked objects one at a time; a scene of millions is never held as objects.
class ObjectSink {
 public:
  virtual ~ObjectSink() = default;

  /// An upper bound on the number of objects to come, for reserving memory.
  virtual void expect(std::size_t /*objects*/) {}

  /// An object of any kind. Its written values have passed check_value or are Nothing; missing
  /// properties have been reported.
  virtual void add(const Object& object) = 0;

  /// Whether no more objects are needed: a limit is exceeded, which has been reported.
  virtual bool is_full() const { return false; }

  /// Begins a group: objects up to leave() are inside it.
  virtual void enter(const Object& /*group*/) {}
  virtual void leave() {}

  /// Whether the sink uses the information which groups have equal contents.
  virtual bool wants_contents() const { return false; }
  /// The group just entered is the first with the contents of this number.
  virtual void begin_contents(std::uint32_t /*contents*/) {}
  /// These contents will not be repeated.
  virtual void forget_contents(std::uint32_t /*contents*/) {}
  /// Adds `group` with known contents, like enter(), add() of each object and leave(). False if it
  /// cannot and did nothing: the caller then adds the objects.
  virtual bool repeat(const Object& /*group*/, std::uint32_t /*contents*/) { return false; }
};

template <typename T>
std::optional<T> Object::get(std::size_t property) const {
  if (auto value = value_as<T>(slots[property].value)) return value;
  if (slots[property].is_written) return std::nullopt;
  const Default& fallback = kind->properties[property].default_value;
  if constexpr (std::is_same_v<T, double> || std::is_same_v<T, bool>) {
    if (const T* value = get_if<T>(&fallback)) return *value;
  } else if constexpr (std::is_same_v<T, Word>) {
    if (const auto* word = get_if<std::string_view>(&fallback)) return Word{std::string(*word)};
  } else if constexpr (std::is_same_v<T, render::Vec3> || std::is_same_v<T, render::LinearRgb>) {
    if (const auto* triple = get_if<std::array<double, 3>>(&fallback)) {
      return T{(*triple)[0], (*triple)[1], (*triple)[2]};
    }
  }
  return std::nullopt;
}

}  // namespace sdlc::lang
