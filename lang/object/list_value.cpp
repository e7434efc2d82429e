#include <algorithm>
#include <limits>
#include <utility>

#include "lang/object/table.hpp"
#include "lang/object/value.hpp"
#include "lang/source/limits.hpp"

namespace sdlc::lang {

/// The shared elements of a list.
struct ListNode {
  explicit ListNode(std::vector<Value> values_)
      : values(std::move(values_)), bytes(sizeof *this + values.capacity() * sizeof(Value)) {
    weight = values.size();
    for (const Value& value : values) {
      constexpr auto kMax = std::numeric_limits<std::uint64_t>::max();
      if (const auto* list = elements_of(value)) {
        weight += std::min(list->weight(), kMax - weight);
      } else if (const auto* text = get_if<std::string>(&value)) {
        weight += std::min<std::uint64_t>(text->size() / work::kBytes, kMax - weight);
      }
    }
  }
  explicit ListNode(std::vector<double> numbers_)
      : numbers(std::move(numbers_)),
        bytes(sizeof *this + numbers.capacity() * sizeof(double)),
        weight(numbers.size()) {}
  explicit ListNode(std::shared_ptr<const Table> table_) : table(std::move(table_)) {}
  ListNode(const ListNode&) = delete;
  ListNode& operator=(const ListNode&) = delete;
  ~ListNode() {
    // The weight is that of the elements alone if lists in it are empty: nothing is nested.
    if (weight > values.size() && numbers.empty()) ListValue::release(std::move(values));
  }

  std::vector<Value> values;
  std::vector<double> numbers;         // in place of values
  std::shared_ptr<const Table> table;  // in place of values
  CountedBytes bytes;
  std::uint64_t weight = 0;
};

ListValue::ListValue(std::vector<Value> values)
    : node_(std::make_shared<ListNode>(std::move(values))), count_(node_->values.size()) {}

ListValue::ListValue(std::vector<double> numbers, Unit unit)
    : node_(std::make_shared<ListNode>(std::move(numbers))),
      count_(node_->numbers.size()),
      unit_(unit) {}

ListValue::ListValue(Scalar first, double step, std::size_t count)
    : first_(first.value), step_(step), count_(count), unit_(first.unit) {}

ListValue::ListValue(Angle first, double step, std::size_t count)
    : first_(first.degrees), step_(step), count_(count), has_angles_(true) {}

ListValue::ListValue(std::shared_ptr<const Table> table)
    : node_(std::make_shared<ListNode>(std::move(table))),
      row_(kAllRows),
      count_(node_->table->row_count()) {}

ListValue::ListValue(std::shared_ptr<ListNode> table, std::size_t row)
    : node_(std::move(table)), row_(row), count_(node_->table->columns().size()) {}

const Table* ListValue::table_of_row() const noexcept {
  return node_ && node_->table && row_ != kAllRows ? node_->table.get() : nullptr;
}

std::uint64_t ListValue::weight() const noexcept {
  if (!node_) return count_;
  if (!node_->table) return node_->weight;
  return row_ == kAllRows ? node_->table->weight() : node_->table->weight_of_row(row_);
}

Value ListValue::operator[](std::size_t i) const {
  if (node_ && !node_->values.empty()) return node_->values[i];
  if (node_ && !node_->numbers.empty()) return Scalar{node_->numbers[i], unit_};
  if (node_ && row_ != kAllRows) return node_->table->cell(row_, i);
  if (node_) {
    ListValue row(node_, i);
    return node_->table->is_uniform() ? Value(std::move(row)) : Value(RowValue{std::move(row)});
  }
  const double value = first_ + step_ * static_cast<double>(i);
  return has_angles_ ? Value(Angle{value}) : Value(Scalar{value, unit_});
}

void ListValue::release(std::vector<Value> values) {
  // A loop instead of recursive destructors: lists may be nested as deeply as calls. While it runs,
  // the lists whose last user goes only add their elements to it.
  thread_local std::vector<std::vector<Value>>* waiting = nullptr;
  if (waiting != nullptr) return waiting->push_back(std::move(values));
  std::vector<std::vector<Value>> nested;
  waiting = &nested;
  nested.push_back(std::move(values));
  while (!nested.empty()) {
    const std::vector<Value> released = std::move(nested.back());
    nested.pop_back();
  }
  waiting = nullptr;
}

}  // namespace sdlc::lang
