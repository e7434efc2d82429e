#include "lang/eval/stack_segments.hpp"

#include <algorithm>

#include <emscripten/stack.h>

// WebAssembly cannot switch stacks, so the only segment is the stack itself. Beside the stack in
// memory, whose addresses are known, engines have another one, of about 1 MB, whose end cannot be
// asked for; to reach it ends the program.
namespace sdlc::lang {
namespace {

/// Of the stack in memory, what recursion may take. V8's stack of 984 KiB is used by two thirds then.
constexpr std::uintptr_t kRecursion = std::uintptr_t{448} << 10;

}  // namespace

void StackSegments::enter() {}

std::uintptr_t StackSegments::limit_of_thread() {
  const std::uintptr_t end = emscripten_stack_get_end();
  const std::uintptr_t here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
  return std::max(end + kReserve, here - std::min(here, kRecursion));
}

bool StackSegments::run(void (*function)(void*), void* argument, std::size_t /*bytes*/) {
  if (limit_ == kUnknown) limit_ = limit_of_thread();
  if (is_low()) return false;
  function(argument);
  return true;
}

}  // namespace sdlc::lang
