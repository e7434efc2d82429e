#include <algorithm>
#include <limits>
#include <utility>

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
      if (const auto* list = get_if<ListValue>(&value)) {
        weight += std::min(list->weight(), kMax - weight);
      } else if (const auto* text = get_if<std::string>(&value)) {
        weight += std::min<std::uint64_t>(text->size() / work::kBytes, kMax - weight);
      } else {
        break;  // the elements are of one type
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

std::uint64_t ListValue::weight() const noexcept { return node_ ? node_->weight : count_; }

Value ListValue::operator[](std::size_t i) const {
  if (node_) return node_->values[i];
  return Scalar{first_ + step_ * static_cast<double>(i)};
}

void ListValue::release(std::vector<Value> values) {
  // A loop instead of recursive destructors: lists may be nested as deeply as the file is long.
  std::vector<std::shared_ptr<ListNode>> waiting;
  const auto take_lists = [&](std::vector<Value>& from) {
    for (Value& value : from) {
      auto* list = value.get_if_unshared<ListValue>();
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
