#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "render/kernel/kernel.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/settings.hpp"

/// Shared by the benchmarks of the renderer. They time whole renders on one thread, from the first
/// path to the last, in CPU time; the cost of a ray is that time divided by the number of rays.
namespace sdlc::bench {

/// A kernel configuration that this machine can run. "float" is mixed if a scene requires it.
struct Form {
  std::string name;  ///< "scalar" or "avx2/float"
  render::KernelRequest request;
};

/// The scalar kernel, then the wide one with each instruction set and precision.
std::vector<Form> forms();
/// The wide kernel with a BVH: "bvh/avx2/float".
std::vector<Form> hierarchy_forms();

struct Timing {
  double seconds = 0;  ///< CPU time of the one thread
  std::uint64_t rays = 0;
  std::uint64_t paths = 0;
  render::Precision precision = render::Precision::Double;

  double nanoseconds_per_ray() const { return seconds * 1e9 / static_cast<double>(rays); }
};

/// Renders once; the time excludes building and choosing the kernel. `depth` counts the rays of a
/// path. Throws if the configuration cannot render the scene.
Timing time_render(const render::Scene& scene, const Form& form, int depth);

/// Registers a benchmark that renders `scene` repeatedly and reports the time per ray and the rays
/// per path.
void register_render(const std::string& name, render::Scene scene, const Form& form,
                     int depth = 16);

/// A scene without spheres, seen from above.
render::Scene empty_scene();
/// A ground of radius `ground`, and eight spheres close above it and to each other. The scene has
/// one matt material per sphere, that of the ground first.
render::Scene eight_on_ground(double ground = 100);

}  // namespace sdlc::bench
