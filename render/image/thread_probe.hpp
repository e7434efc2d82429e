#pragma once

namespace sdlc::render {

/// Starts up to `count` threads at a time and ends them; how many did start. Nothing else tells how
/// many could: limits are those of a user, a container, an address space.
int startable_threads(int count);

}  // namespace sdlc::render
