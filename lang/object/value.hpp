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
struct RowValue;

using Value = Variant<Nothing, Scalar, bool, Triple, Angle, AngleTriple, render::LinearRgb, Bounds,
                      MaterialValue, MotionValue, None, std::string, Word, ListValue, RowValue>;

struct ListNode;
class Table;

/// A sequence of values of one type. Copies share the elements, which are immutable. An arithmetic
/// progression (the result of `range`) takes constant memory, and the rows of a data file stay in
/// the columns of their table.
class ListValue {
 public:
  explicit ListValue(std::vector<Value> values);
  /// Numbers of one unit, at least one: 8 bytes each.
  ListValue(std::vector<double> numbers, Unit unit);
  /// first, first + step, …: `count` numbers of one unit, or angles and a step in degrees.
  ListValue(Scalar first, double step, std::size_t count);
  ListValue(Angle first, double step, std::size_t count);
  /// The rows of a table.
  explicit ListValue(std::shared_ptr<const Table> table);

  std::size_t size() const noexcept { return count_; }
  /// The steps (see limits.hpp) of reading all of it: one per element, nested lists included as
  /// often as they occur, plus those of strings; saturates at 2^64 - 1.
  std::uint64_t weight() const noexcept;
  /// Precondition: i < size().
  Value operator[](std::size_t i) const;
  /// The table of which this is one row, or null: its columns have names.
  const Table* table_of_row() const noexcept;

  /// Destroys values without recursion into nested lists.
  static void release(std::vector<Value> values);

 private:
  static constexpr std::size_t kAllRows = static_cast<std::size_t>(-1);

  /// The cells of row `row` of a table.
  ListValue(std::shared_ptr<ListNode> table, std::size_t row);

  std::shared_ptr<ListNode> node_;  // null: a progression
  double first_ = 0;
  union {
    double step_ = 1;  // of a progression
    std::size_t row_;  // of a table; kAllRows: all
  };
  std::size_t count_ = 0;
  Unit unit_ = Unit::None;
  bool has_angles_ = false;
};

/// A list of several types: one row of a table. What works on all elements of a list alike does not
/// take it. (A row of a data file whose cells are of one type is a ListValue.)
struct RowValue {
  ListValue elements;
};

/// The elements of a list or row; null for other values.
inline const ListValue* elements_of(const Value& value) noexcept {
  if (const auto* row = get_if<RowValue>(&value)) return &row->elements;
  return get_if<ListValue>(&value);
}

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
/// "m", "s" or nothing.
std::string_view suffix_of(Unit unit) noexcept;
/// The shortest spelling that reads back as the same number.
std::string to_text(double number);

}  // namespace sdlc::lang
