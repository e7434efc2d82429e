#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "bench/benchmarks.hpp"
#include "bench/renders.hpp"

// The cost of finding the nearest of n spheres. The wide kernel's search cannot be called alone, so
// this renders pictures whose time is almost only that search: the growth with n is the search, the
// rest at small n is the path around it. "camera" has only camera rays, which are coherent across
// lanes; "scattered" has paths of matt spheres, whose rays are incoherent. The number of spheres
// above which a BVH is used follows from these numbers.
namespace sdlc::bench {
namespace {

/// `count` spheres in a cube; none touches another.
render::Scene cube_of_spheres(int count, const render::Material& material) {
  render::Scene scene = empty_scene();
  const int side = static_cast<int>(std::ceil(std::cbrt(count)));
  std::mt19937_64 engine(3);
  const auto jitter = [&] { return (static_cast<double>(engine() >> 11) * 0x1p-53 - 0.5) * 0.2; };
  for (int i = 0; i < count; ++i) {
    const render::Vec3 place{i % side + jitter(), i / side % side + jitter(),
                             i / (side * side) + jitter()};
    const double middle = (side - 1) / 2.0;
    scene.spheres.push_back(
        {.center = place - render::Vec3{middle, middle, middle}, .radius = 0.4});
  }
  scene.materials = {material};
  scene.camera = {.from = render::Vec3{0.9, 0.7, 2} * side, .at = {0, 0, 0}, .plane_height = 0.35};
  return scene;
}

}  // namespace

void register_intersection_benchmarks() {
  std::vector<Form> all = forms();
  for (const Form& form : hierarchy_forms()) all.push_back(form);
  for (const int count : {4, 9, 16, 32, 64, 128, 256}) {
    for (const Form& form : all) {
      const std::string spheres = std::to_string(count);
      register_render("intersection/camera/" + spheres,
                      cube_of_spheres(count, {.color = render::LinearRgb{0.5},
                                              .type = render::MaterialType::Unlit}),
                      form, 1);
      register_render("intersection/scattered/" + spheres,
                      cube_of_spheres(count, {.color = render::LinearRgb{0.5}}), form);
    }
  }
}

}  // namespace sdlc::bench
