#include "lang/value/computed.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "lang/source/limits.hpp"

namespace sdlc::lang {
namespace {

struct Describe {
  std::string_view operator()(Failed) const { return "nothing"; }
  std::string_view operator()(Scalar scalar) const {
    switch (scalar.unit) {
      case Unit::None: return "a number";
      case Unit::Length: return "a length";
      case Unit::Time: return "a time";
    }
    return "";
  }
  std::string_view operator()(bool) const { return "true or false"; }
  std::string_view operator()(const std::string&) const { return "a string"; }
  std::string_view operator()(Triple triple) const {
    return triple.unit == Unit::Time ? "three times" : "a point (x, y, z)";
  }
  std::string_view operator()(Angle) const { return "an angle"; }
  std::string_view operator()(AngleTriple) const { return "three angles"; }
  std::string_view operator()(render::LinearRgb) const { return "a colour"; }
  std::string_view operator()(Bounds bounds) const {
    return bounds.unit == Unit::Length ? "an interval of lengths" : "an interval a .. b";
  }
  std::string_view operator()(const MaterialValue&) const { return "a material"; }
  std::string_view operator()(const MotionValue&) const { return "a motion"; }
  std::string_view operator()(const Word&) const { return "a word"; }
  std::string_view operator()(None) const { return "`none`"; }
  std::string_view operator()(const ListValue&) const { return "a list"; }
};

}  // namespace

/// The elements of a list, and the only owner of lists inside it.
struct ListNode {
  explicit ListNode(std::vector<Computed> values_)
      : values(std::move(values_)), bytes(sizeof *this + values.capacity() * sizeof(Computed)) {
    weight = values.size();
    for (const Computed& value : values) {
      constexpr auto kMost = std::numeric_limits<std::uint64_t>::max();
      if (const auto* list = get_if<ListValue>(&value)) {
        weight += std::min(list->weight(), kMost - weight);
      } else if (const auto* text = get_if<std::string>(&value)) {
        weight += std::min<std::uint64_t>(text->size() / work::kBytes, kMost - weight);
      } else {
        break;  // the elements are of one type
      }
    }
  }
  ListNode(const ListNode&) = delete;
  ListNode& operator=(const ListNode&) = delete;
  ~ListNode() { ListValue::release(std::move(values)); }

  std::vector<Computed> values;
  CountedBytes bytes;
  std::uint64_t weight = 0;
};

ListValue::ListValue(std::vector<Computed> values)
    : node_(std::make_shared<ListNode>(std::move(values))), count_(node_->values.size()) {}

ListValue::ListValue(double first, double step, std::size_t count)
    : first_(first), step_(step), count_(count) {}

std::uint64_t ListValue::weight() const noexcept { return node_ ? node_->weight : count_; }

Computed ListValue::operator[](std::size_t i) const {
  if (node_) return node_->values[i];
  return Scalar{first_ + step_ * static_cast<double>(i)};
}

void ListValue::release(std::vector<Computed> values) {
  // Lists in lists in lists, as deep as a file can make them: a loop, where destructors would
  // recur.
  std::vector<std::shared_ptr<ListNode>> waiting;
  const auto take_lists = [&](std::vector<Computed>& from) {
    for (Computed& value : from) {
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

std::string_view describe(const Computed& value) noexcept { return visit(Describe(), value); }

}  // namespace sdlc::lang
