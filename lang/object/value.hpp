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

/// The tag of a number: lengths are in metres, times in seconds; they do not add up.
enum class Unit : std::uint8_t { None, Length, Time };

/// No value: none is written, or an error has been reported. Computing with it gives Nothing again
/// and reports nothing.
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

/// A word of a property, not a name: `tone: sqrt`.
struct Word {
  std::string text;

  friend bool operator==(const Word&, const Word&) = default;
};

/// The word `none` of a property that accepts it.
struct None {
  friend bool operator==(const None&, const None&) = default;
};

/// A material constructor with its arguments filled in.
struct MaterialValue {
  MaterialKind kind = MaterialKind::Diffuse;
  render::LinearRgb color;
  double parameter = 0;        ///< fuzz, ior or intensity, by kind
  bool exact_fresnel = false;  ///< of transmissive

  friend bool operator==(const MaterialValue&, const MaterialValue&) = default;
};

/// Linear motion of a sphere: its centre is `center` at time over.from and `to` at time over.to,
/// extrapolated before and after.
struct MotionValue {
  render::Vec3 to;
  render::Interval over;  ///< seconds; the ends differ

  friend bool operator==(const MotionValue&, const MotionValue&) = default;
};

class ListValue;

using Value = Variant<Nothing, Scalar, bool, Triple, Angle, AngleTriple, render::LinearRgb, Bounds,
                      MaterialValue, MotionValue, None, std::string, Word, ListValue>;

struct ListNode;

/// A sequence of values of one type. Copies share the elements, which are immutable. An arithmetic
/// progression (the result of `range`) takes constant memory.
class ListValue {
 public:
  explicit ListValue(std::vector<Value> values);
  /// first, first + step, …: `count` numbers.
  ListValue(double first, double step, std::size_t count);

  std::size_t size() const noexcept { return count_; }
  /// The steps (see limits.hpp) of reading all of it: one per element, nested lists included as
  /// often as they occur, plus those of strings; saturates at 2^64 - 1.
  std::uint64_t weight() const noexcept;
  /// Precondition: i < size().
  Value operator[](std::size_t i) const;

  /// Destroys values without recursion into nested lists.
  static void release(std::vector<Value> values);

 private:
  std::shared_ptr<ListNode> node_;  // null: a progression
  double first_ = 0, step_ = 1;
  std::size_t count_ = 0;
};

inline bool is_nothing(const Value& value) noexcept { return holds_alternative<Nothing>(value); }

/// The value as a T if it is one. double, render::Vec3 and render::Interval are those of a Scalar,
/// Triple and Bounds, without the unit.
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

/// The value's type for messages: "a number", "a length".
std::string_view describe(const Value& value) noexcept;
/// The value in the syntax of the language, for messages: "-1", "40deg".
std::string to_text(const Value& value);
/// The shortest spelling that reads back as the same number.
std::string to_text(double number);

}  // namespace sdlc::lang
