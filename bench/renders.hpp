#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "render/scene/scene.hpp"
#include "render/tiles/kernel.hpp"

/// What the benchmarks of the renderer share. They time whole renders on one thread, from the first
/// path to the last, in CPU time: what a ray costs is what is left of a picture when it is divided
/// by its rays.
namespace sdlc::bench {

/// A kernel in one of the forms that this machine can run. "float" is mixed where a scene asks for
/// that.
struct Form {
  std::string name;  ///< "scalar" or "avx2/float"
  render::KernelRequest request;
};

/// The scalar kernel, then the wide one in each instruction set and precision.
std::vector<Form> forms();
/// The wide kernel's paths with a hierarchy: "bvh/avx2/float".
std::vector<Form> hierarchy_forms();

struct Timing {
  double seconds = 0;  ///< CPU time of the one thread
  std::uint64_t rays = 0;
  std::uint64_t paths = 0;
  render::Precision precision = render::Precision::Double;

  double nanoseconds_a_ray() const { return seconds * 1e9 / static_cast<double>(rays); }
};

/// Renders once, without building and choosing the kernel in the time. `depth` counts the rays of a
/// path. Throws if the form does not take the scene.
Timing time_render(const render::Scene& scene, const Form& form, int depth);

/// A benchmark that renders `scene` again and again and reports the time of a ray, and how many
/// rays a path has.
void register_render(const std::string& name, render::Scene scene, const Form& form,
                     int depth = 16);

/// A scene without spheres, seen from above.
render::Scene empty_scene();
/// A ground of radius `ground`, and eight spheres close above it and to each other. The scene has
/// one material for each sphere, that of the ground first, all of them matt.
render::Scene eight_on_ground(double ground = 100);

}  // namespace sdlc::bench
