#include "lang/eval/stack_segments.hpp"

#include <algorithm>
#include <exception>
#include <memory>

#include <pthread.h>
#include <sys/mman.h>
#include <ucontext.h>

#include "lang/object/counted_bytes.hpp"

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/common_interface_defs.h>
#elif defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
#endif

namespace sdlc::lang {
namespace {

constexpr std::size_t kSegmentBytes = std::size_t{1} << 20;
constexpr std::size_t kGuardBytes = std::size_t{64} << 10;  // a multiple of any page size

}  // namespace

/// A segment of a stack, with a guard below it, and what runs on it.
class StackSegments::Segment {
 public:
  /// Null if the system has no memory for it.
  static std::unique_ptr<Segment> make(std::size_t bytes) {
    void* const memory = mmap(nullptr, bytes + kGuardBytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (memory == MAP_FAILED) return nullptr;
    if (mprotect(memory, kGuardBytes, PROT_NONE) != 0) {
      munmap(memory, bytes + kGuardBytes);
      return nullptr;
    }
    return std::unique_ptr<Segment>(new Segment(static_cast<char*>(memory), bytes));
  }
  ~Segment() {
#if defined(__SANITIZE_THREAD__)
    __tsan_destroy_fiber(fiber_);
#endif
    munmap(memory_, size_ + kGuardBytes);
  }
  Segment(const Segment&) = delete;
  Segment& operator=(const Segment&) = delete;

  std::size_t size() const noexcept { return size_; }

  void run(void (*function)(void*), void* argument) {
    function_ = function;
    argument_ = argument;
    getcontext(&inside_);
    inside_.uc_stack.ss_sp = memory_ + kGuardBytes;
    inside_.uc_stack.ss_size = size_;
    inside_.uc_link = &outside_;
    makecontext(&inside_, &StackSegments::enter, 0);
    entered_ = this;
    const auto low = reinterpret_cast<std::uintptr_t>(memory_) + kGuardBytes;
    const std::uintptr_t outer = std::exchange(limit_, low + scaled(kReserve));
    bytes_.set(size_);
    switch_inside();
    bytes_.set(0);
    limit_ = outer;
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
  }

  /// The first function on the segment.
  static void begin() {
    Segment& self = *entered_;
    self.finish_switch(nullptr);
    try {
      self.function_(self.argument_);
    } catch (...) {
      self.thrown_ = std::current_exception();
    }
    self.prepare_return();
  }

  /// The last one that was left: a loop of calls at the end of a segment enters it many times.
  static inline thread_local std::unique_ptr<Segment> spare_;

 private:
  Segment(char* memory, std::size_t size) : memory_(memory), size_(size) {
#if defined(__SANITIZE_THREAD__)
    fiber_ = __tsan_create_fiber(0);
#endif
  }

  void switch_inside() {
#if defined(__SANITIZE_ADDRESS__)
    void* fake_stack = nullptr;
    __sanitizer_start_switch_fiber(&fake_stack, memory_ + kGuardBytes, size_);
    swapcontext(&outside_, &inside_);
    finish_switch(fake_stack);
#else
#if defined(__SANITIZE_THREAD__)
    outer_fiber_ = __tsan_get_current_fiber();
    __tsan_switch_to_fiber(fiber_, 0);
#endif
    swapcontext(&outside_, &inside_);
#endif
  }

  void finish_switch([[maybe_unused]] void* fake_stack) {
#if defined(__SANITIZE_ADDRESS__)
    const void* bottom = nullptr;
    std::size_t size = 0;
    __sanitizer_finish_switch_fiber(fake_stack, &bottom, &size);
    if (fake_stack == nullptr) outer_bottom_ = bottom, outer_size_ = size;
#endif
  }

  /// Before the first function returns to the stack outside.
  void prepare_return() {
#if defined(__SANITIZE_ADDRESS__)
    __sanitizer_start_switch_fiber(nullptr, outer_bottom_, outer_size_);
#elif defined(__SANITIZE_THREAD__)
    __tsan_switch_to_fiber(outer_fiber_, 0);
#endif
  }

  static inline thread_local constinit Segment* entered_ = nullptr;

  char* memory_;
  std::size_t size_;
  void (*function_)(void*) = nullptr;
  void* argument_ = nullptr;
  ucontext_t outside_{}, inside_{};
  std::exception_ptr thrown_;
  CountedBytes bytes_;  // while it runs
  [[maybe_unused]] const void* outer_bottom_ = nullptr;
  [[maybe_unused]] std::size_t outer_size_ = 0;
  [[maybe_unused]] void *fiber_ = nullptr, *outer_fiber_ = nullptr;
};

void StackSegments::enter() { Segment::begin(); }

std::uintptr_t StackSegments::limit_of_thread() {
  pthread_attr_t attributes;
  void* low = nullptr;
  std::size_t size = 0;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return kUnknown;
  pthread_attr_getstack(&attributes, &low, &size);
  pthread_attr_destroy(&attributes);
  return reinterpret_cast<std::uintptr_t>(low) + scaled(kReserve);
}

bool StackSegments::run(void (*function)(void*), void* argument, std::size_t bytes) {
  if (limit_ == kUnknown) {
    limit_ = limit_of_thread();
    if (limit_ != kUnknown && !has_less_than(bytes)) return function(argument), true;
  }
  const std::size_t size = std::max(scaled(kSegmentBytes), scaled(bytes + 2 * kReserve));
  std::unique_ptr<Segment> segment = std::move(Segment::spare_);
  if (segment == nullptr || segment->size() != size) segment = Segment::make(size);
  if (segment == nullptr) return false;
  segment->run(function, argument);
  Segment::spare_ = std::move(segment);
  return true;
}

}  // namespace sdlc::lang
