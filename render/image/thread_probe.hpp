#pragma once

namespace sdlc::render {

/// Starts up to `count` threads at the same time, ends them, and returns how many could be started.
/// There is no other way to find out: a user, a container and an address space each have limits.
int startable_threads(int count);

}  // namespace sdlc::render
