#pragma once

#include <cstddef>
#include <vector>

#include "lang/object/value.hpp"

namespace sdlc::lang {

/// The type that the elements of a list have in common. A number without a unit goes with any unit,
/// but two units do not go together: so the type is more than that of the first element.
class ElementType {
 public:
  /// Whether the value can be an element beside those before. If so, the type takes its units.
  /// Takes time in proportion to the weight of a row.
  bool admit(const Value& value);
  /// That of the numbers, vectors or intervals.
  Unit unit() const noexcept { return units_.empty() ? Unit::None : units_.front(); }

 private:
  bool admit_row(const RowValue& row);
  /// Whether the unit at this place of the type goes with another, which it takes.
  bool admit_unit(std::size_t place, Unit unit);

  Value first_;
  std::vector<Unit> units_;  // by place; None after the end
};

}  // namespace sdlc::lang
