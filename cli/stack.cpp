#include "cli/stack.hpp"

#include <cstddef>

#include <pthread.h>
#include <sys/resource.h>

namespace sdlc::cli {
namespace {

// The default stack size of Linux.
constexpr std::size_t kStackBytes = std::size_t{8} << 20;

void* call(void* function) {
  (*static_cast<std::function<void()>*>(function))();
  return nullptr;
}

}  // namespace

bool run_on_large_stack(std::function<void()> function) {
  struct rlimit stack {};
  if (getrlimit(RLIMIT_STACK, &stack) != 0 || stack.rlim_cur >= kStackBytes) {
    function();
    return true;
  }
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
#ifdef __GLIBC__
  pthread_setattr_default_np(&attributes);  // for threads that libraries start
#endif
  pthread_t thread{};
  const bool is_started = pthread_create(&thread, &attributes, call, &function) == 0;
  pthread_attr_destroy(&attributes);
  if (is_started) pthread_join(thread, nullptr);
  return is_started;
}

}  // namespace sdlc::cli
