// Loaded with LD_PRELOAD: allows at most FEW_THREADS additional threads at a time, like `ulimit
// -u`, which has no effect for root.

#include <atomic>
#include <cerrno>
#include <cstdlib>

#include <dlfcn.h>
#include <pthread.h>

namespace {

std::atomic<int> living{0};

struct Start {
  void* (*function)(void*);
  void* argument;
};

int limit() {
  const char* text = std::getenv("FEW_THREADS");
  return text == nullptr ? 1 << 30 : std::atoi(text);
}

void* run(void* data) {
  const Start start = *static_cast<Start*>(data);
  delete static_cast<Start*>(data);
  void* result = start.function(start.argument);
  --living;
  return result;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) int pthread_create(
    pthread_t* thread, const pthread_attr_t* attributes, void* (*function)(void*),
    void* argument) noexcept {
  using Create = int (*)(pthread_t*, const pthread_attr_t*, void* (*)(void*), void*);
  static const auto create = reinterpret_cast<Create>(dlsym(RTLD_NEXT, "pthread_create"));
  if (++living > limit()) {
    --living;
    return EAGAIN;
  }
  return create(thread, attributes, run, new Start{function, argument});
}
