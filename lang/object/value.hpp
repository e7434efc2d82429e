#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "lang/object/variant.hpp"
#include "lang/schema/schema.hpp"
#include "render/math/color.hpp"
#include "render/math/interval.hpp"
#include "render/math/vec3.hpp"

/// The values of the language: what expressions compute and properties hold.
namespace sdlc::lang {

/// The tag of a number (ruling 20): metres and seconds are 1, and do not add up.
enum class Unit : std::uint8_t { None, Length, Time };

/// No value: nothing is written, or what is written is wrong and has been reported. Whatever is
/// computed from it is silent.
struct Nothing {};

struct Scalar {
  double value = 0;
  Unit unit = Unit::None;
};

/// A point or a displacement.
struct Triple {
  render::Vec3 value;
  Unit unit = Unit::None;
};

/// `from .. to`
struct Bounds {
  double from = 0, to = 0;
  Unit unit = Unit::None;
};

struct Angle {
  double degrees = 0;

  friend bool operator==(const Angle&, const Angle&) = default;
};

/// Angles about the three axes.
struct AngleTriple {
  render::Vec3 degrees;

  friend bool operator==(const AngleTriple&, const AngleTriple&) = default;
};

/// A name that is its own value: `tone: sqrt`.
struct Word {
  std::string text;

  friend bool operator==(const Word&, const Word&) = default;
};

/// The word `none`, where a property takes it.
struct None {
  friend bool operator==(const None&, const None&) = default;
};

/// A material constructor with its arguments filled in.
struct MaterialValue {
  MaterialKind kind = MaterialKind::Diffuse;
  render::LinearRgb color;
  double parameter = 0;        ///< fuzz, ior or intensity, as the kind has it
  bool exact_fresnel = false;  ///< of transmissive

  friend bool operator==(const MaterialValue&, const MaterialValue&) = default;
};

/// Straight motion of a centre: at its own place at time over.from, at `to` at time over.to,
/// extrapolated.
struct MotionValue {
  render::Vec3 to;
  render::Interval over;  ///< seconds; the ends differ

  friend bool operator==(const MotionValue&, const MotionValue&) = default;
};

class ListValue;

using Value = Variant<Nothing, Scalar, bool, Triple, Angle, AngleTriple, render::LinearRgb, Bounds,
                      MaterialValue, MotionValue, None, std::string, Word, ListValue>;

struct ListNode;

/// Values of one type, in an order. Copies share the values, which never change. A row of whole
/// numbers (what `range` makes) is stored as its rule, however long it is.
class ListValue {
 public:
  explicit ListValue(std::vector<Value> values);
  /// first, first + step, …: `count` numbers.
  ListValue(double first, double step, std::size_t count);

  std::size_t size() const noexcept { return count_; }
  /// The steps of reading all of it: its elements and those of the lists inside it, each as often
  /// as it occurs, and the steps of their strings; at most 2^64 - 1.
  std::uint64_t weight() const noexcept;
  /// Precondition: i < size().
  Value operator[](std::size_t i) const;

  /// Destroys values without recurring into lists of lists.
  static void release(std::vector<Value> values);

 private:
  std::shared_ptr<ListNode> node_;  // null: a row
  double first_ = 0, step_ = 1;
  std::size_t count_ = 0;
};

inline bool is_nothing(const Value& value) noexcept { return holds_alternative<Nothing>(value); }

/// The value as a T if it is one. Numbers, points and intervals are also read as double,
/// render::Vec3 and render::Interval, without their unit.
template <typename T>
std::optional<T> value_as(const Value& value) noexcept {
  if constexpr (std::is_same_v<T, double>) {
    const auto* scalar = get_if<Scalar>(&value);
    return scalar != nullptr ? std::optional(scalar->value) : std::nullopt;
  } else if constexpr (std::is_same_v<T, render::Vec3>) {
    const auto* triple = get_if<Triple>(&value);
    return triple != nullptr ? std::optional(triple->value) : std::nullopt;
  } else if constexpr (std::is_same_v<T, render::Interval>) {
    const auto* bounds = get_if<Bounds>(&value);
    return bounds != nullptr ? std::optional(render::Interval{bounds->from, bounds->to})
                             : std::nullopt;
  } else {
    const T* found = get_if<T>(&value);
    return found != nullptr ? std::optional(*found) : std::nullopt;
  }
}

/// "a number", "a length": what a message calls the value.
std::string_view describe(const Value& value) noexcept;
/// The value as the language spells it, for messages ("-1", "40deg").
std::string to_text(const Value& value);
/// The shortest spelling that reads back as the same number.
std::string to_text(double number);

}  // namespace sdlc::lang
