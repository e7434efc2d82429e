#include "lang/value/element_type.hpp"

#include <utility>

#include "lang/value/logic.hpp"

namespace sdlc::lang {

bool ElementType::admit(const Value& value) {
  if (is_nothing(first_)) {
    first_ = value;
    return admit_unit(0, unit_of(value));
  }
  if (!are_alike(first_, value)) return false;
  const auto* row = get_if<RowValue>(&value);
  return row != nullptr ? admit_row(*row) : admit_unit(0, unit_of(value));
}

bool ElementType::admit_unit(std::size_t place, Unit unit) {
  if (unit == Unit::None) return true;
  if (place >= units_.size()) units_.resize(place + 1, Unit::None);
  if (!are_compatible(units_[place], unit)) return false;
  units_[place] = unit;
  return true;
}

/// A loop instead of recursion, as in are_of_one_type(). Rows of one shape number their places
/// alike.
bool ElementType::admit_row(const RowValue& row) {
  std::vector<std::pair<ListValue, ListValue>> waiting{
      {get<RowValue>(first_).elements, row.elements}};
  std::size_t place = 0;
  while (!waiting.empty()) {
    const auto [first, other] = std::move(waiting.back());
    waiting.pop_back();
    if (first.size() != other.size()) return false;
    const Table* table = first.table_of_row();
    if (table != nullptr && table == other.table_of_row()) {
      place += first.size();
      continue;
    }
    for (std::size_t i = 0; i < first.size(); ++i, ++place) {
      const Value x = first[i], y = other[i];
      if (!are_alike(x, y)) return false;
      if (!admit_unit(place, unit_of(x)) || !admit_unit(place, unit_of(y))) return false;
      const auto* inner = get_if<RowValue>(&x);
      if (inner != nullptr) waiting.emplace_back(inner->elements, get<RowValue>(y).elements);
    }
  }
  return true;
}

}  // namespace sdlc::lang
