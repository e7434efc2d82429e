#include <algorithm>
#include <utility>

#include "lang/eval/evaluator.hpp"

// Limits on steps, memory, nesting and calls.
namespace sdlc::lang {

bool Evaluator::may_call(const Code& code, NodeIndex node) {
  // A function that calls itself twice would reach a limit of n calls 2^n times: end the outermost
  // call.
  if (has_called_too_deep_) return false;
  const std::uint64_t max = program_.limits().calls;
  if (calls_ < max) return true;
  has_called_too_deep_ = true;
  sink_.report(diag::too_deep, ast::Node(*code.tree, node).head_location(), max)
      .help("`--limit calls=N` allows more");
  return false;
}

void Evaluator::end_call() {
  if (--calls_ == 0) has_called_too_deep_ = false;
}

std::uint64_t Evaluator::steps_to_read(const Value& value) noexcept {
  if (const ListValue* list = elements_of(value)) return list->weight();
  if (const auto* text = get_if<std::string>(&value)) return text->size() / work::kBytes;
  return 0;
}

bool Evaluator::take_steps(const Code& code, NodeIndex node, std::uint64_t count) {
  if (steps_ <= max_steps_ && count <= max_steps_ - steps_) [[likely]] {
    steps_ += count;
    if (steps_ >= next_poll_) poll();
    return CountedBytes::sum() <= program_.limits().memory || may_take_memory(code, node, 0);
  }
  if (give_up() && !is_allowance_withheld_) {
    sink_.report(diag::too_many_steps, location(code, node), program_.limits().steps)
        .help("`--limit steps=N` allows more");
  }
  return false;
}

void Evaluator::poll() {
  constexpr std::uint64_t kSteps = 1'000;  // a step takes 10 ns, in lists up to a microsecond
  next_poll_ = steps_ + kSteps;
  sink_.stop_if_requested();
}

bool Evaluator::give_up() {
  max_steps_ = 0;
  ++steps_;
  return !std::exchange(has_given_up_, true);
}

std::uint64_t Evaluator::steps() const noexcept {
  return steps_ - std::min(steps_, allowed_steps_);
}

void Evaluator::allow_steps(std::uint64_t spheres) {
  if (objects_->is_full()) give_up();
  if (has_given_up_) return;
  if (sink_.has_errors()) {
    is_allowance_withheld_ = true;
    return;
  }
  constexpr std::uint64_t kMaxPerSphere = std::uint64_t{1} << 32;  // so that no sum overflows
  const std::uint64_t steps =
      spheres * std::min(program_.limits().steps / work::kSpheres, kMaxPerSphere);
  allowed_steps_ += steps;
  max_steps_ += steps;
}

bool Evaluator::may_take_memory(const Code& code, NodeIndex node, std::uint64_t bytes) {
  const std::uint64_t max = program_.limits().memory, taken = CountedBytes::sum();
  if (taken <= max && bytes <= max - taken) [[likely]]
    return true;
  if (give_up()) {
    sink_.report(diag::too_much_memory, location(code, node), max)
        .help("`--limit memory=N` allows more");
  }
  return false;
}

std::optional<std::size_t> Evaluator::open_frame(const Code& code, NodeIndex node,
                                                 std::size_t slots) {
  const std::size_t base = locals_.size(), size = base + slots;
  if (size > locals_.capacity()) {
    const std::size_t capacity = std::max(size, 2 * locals_.capacity());
    if (!may_take_memory(code, node, capacity * sizeof(Varying))) return std::nullopt;
    locals_.reserve(capacity);
    locals_bytes_.set(locals_.capacity() * sizeof(Varying));
  }
  steps_ += slots * work::kSlot;
  locals_.resize(size);
  return base;
}

}  // namespace sdlc::lang
