#pragma once

namespace sdlc::render {

/// The number of threads that the libraries of the image codec start while they are loaded, with
/// some margin: four of log4cplus, one of OpenImageIO. The libraries abort the process, or wait
/// forever, if one cannot be started.
inline constexpr int kCodecThreads = 6;

/// Starts up to `count` threads at the same time, ends them, and returns how many could be started.
/// There is no other way to find out: a user, a container and an address space each have limits.
int startable_threads(int count);

}  // namespace sdlc::render
