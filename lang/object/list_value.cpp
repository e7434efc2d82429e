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
  ListNode(const ListNode&) = delete;
  ListNode& operator=(const ListNode&) = delete;
  ~ListNode() { ListValue::release(std::move(values)); }

  std::vector<Value> values;
  CountedBytes bytes;
  std::uint64_t weight = 0;
};

ListValue::ListValue(std::vector<Value> values)
    : node_(std::make_shared<ListNode>(std::move(values))), count_(node_->values.size()) {}

ListValue::ListValue(double first, double step, std::size_t count)
    : first_(first), step_(step), count_(count) {}

ListValue::ListValue(std::shared_ptr<const Table> table)
    : table_(std::move(table)), count_(table_->row_count()) {}

ListValue::ListValue(std::shared_ptr<const Table> table, std::size_t row)
    : table_(std::move(table)), row_(row), count_(table_->columns().size()) {}

std::uint64_t ListValue::weight() const noexcept {
  if (node_) return node_->weight;
  if (!table_) return count_;
  return row_ == kAllRows ? table_->weight() : table_->weight_of_row(row_);
}

Value ListValue::operator[](std::size_t i) const {
  if (node_) return node_->values[i];
  if (table_ && row_ != kAllRows) return table_->cell(row_, i);
  if (table_) {
    ListValue row(table_, i);
    return table_->is_uniform() ? Value(std::move(row)) : Value(RowValue{std::move(row)});
  }
  return Scalar{first_ + step_ * static_cast<double>(i)};
}

void ListValue::release(std::vector<Value> values) {
  // A loop instead of recursive destructors: lists may be nested as deeply as the file is long.
  std::vector<std::shared_ptr<ListNode>> waiting;
  const auto take_lists = [&](std::vector<Value>& from) {
    for (Value& value : from) {
      auto* row = value.get_if_unshared<RowValue>();
      auto* list = row != nullptr ? &row->elements : value.get_if_unshared<ListValue>();
      if (list != nullptr && list->node_ && list->node_.use_count() == 1) {
        waiting.push_back(std::move(list->node_));
      }
    }
  };
  take_lists(values);
  while (!waiting.empty()) {
    const std::shared_ptr<ListNode> node = std::move(waiting.back());
    waiting.pop_back();
    take_lists(node->values);
  }
}

}  // namespace sdlc::lang
