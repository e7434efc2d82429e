#include "render/parallel/thread_probe.hpp"

namespace sdlc::render {

// As many as the page has started workers for, which is what hardware_concurrency() is here, or
// none; a thread that cannot be started is no error where threads are used.
int startable_threads(int count) { return count; }

}  // namespace sdlc::render
