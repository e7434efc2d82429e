#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "lang/object/object.hpp"
#include "lang/object/variant.hpp"
#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::lang {

/// The tag of a number (ruling 20): metres and seconds are 1, and do not add up.
enum class Unit : std::uint8_t { None, Length, Time };

struct Scalar {
  double value = 0;
  Unit unit = Unit::None;
};

struct Triple {
  render::Vec3 value;
  Unit unit = Unit::None;
};

/// `from .. to`
struct Bounds {
  double from = 0, to = 0;
  Unit unit = Unit::None;
};

/// What has been reported; whatever is computed from it is silent.
struct Failed {};

class ListValue;

/// What an expression computes, with the tags and types that a property has not yet asked for.
using Computed = Variant<Failed, Scalar, bool, Triple, Angle, AngleTriple, render::LinearRgb,
                         Bounds, MaterialValue, MotionValue, None, std::string, Word, ListValue>;

struct ListNode;

/// Values of one type, in an order. Copies share the values, which never change. A row of whole
/// numbers (what `range` makes) is held as its rule, however long it is.
class ListValue {
 public:
  explicit ListValue(std::vector<Computed> values);
  /// first, first + step, …: `count` numbers.
  ListValue(double first, double step, std::size_t count);

  std::size_t size() const noexcept { return count_; }
  /// Elements of it and of the lists inside it, each as often as it stands there, with the steps
  /// that their strings take; 2^64 - 1 where there are more. What looking at all of them costs.
  std::uint64_t weight() const noexcept;
  /// Precondition: i < size().
  Computed operator[](std::size_t i) const;

  /// Destroys values without recurring into lists of lists.
  static void release(std::vector<Computed> values);

 private:
  std::shared_ptr<ListNode> node_;  // null: a row
  double first_ = 0, step_ = 1;
  std::size_t count_ = 0;
};

inline bool has_failed(const Computed& value) noexcept { return holds_alternative<Failed>(value); }

/// "a number", "a length": what a message calls the value.
std::string_view describe(const Computed& value) noexcept;

}  // namespace sdlc::lang
