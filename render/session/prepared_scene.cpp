#include "render/session/prepared_scene.hpp"

#include <stdexcept>
#include <utility>

#include "render/kernel/glints.hpp"
#include "render/math/clock.hpp"
#include "render/parallel/workers.hpp"

namespace sdlc::render {
PreparedScene::PreparedScene(Kernel kernel, Scene scene, int threads) : kernel_(std::move(kernel)) {
  const auto start = Clock::now();
  Workers(threads).run([&] {
    const Glints glints = find_glints(scene, kernel_.casters, kernel_.lights);
    emitters_ = EmitterClasses(scene, kernel_.lights, kernel_.casters, glints.are_complete,
                               kernel_.samples_at_metal);
    tracer_ = make_tracer(std::move(scene), {.precision = kernel_.precision,
                                             .backend = kernel_.backend,
                                             .search = kernel_.search,
                                             .exact_spheres = kernel_.exact_spheres,
                                             .near_pairs = kernel_.bounds.near_pairs,
                                             .lights = kernel_.lights,
                                             .casters = kernel_.casters,
                                             .glints = glints.images,
                                             .samples_at_metal = kernel_.samples_at_metal});
  });
  // For a lattice of touching spheres they are larger than the spheres.
  kernel_.bounds.near_pairs.reset();
  build_seconds_ = seconds_since(start);
}

PreparedScene prepare(Scene scene, const RenderSettings& settings, const KernelRequest& request) {
  const auto start = Clock::now();
  Kernel kernel = choose_kernel(scene, settings, request);
  if (kernel.refusal) throw std::invalid_argument(describe(kernel.refusal->obstacle));
  PreparedScene prepared(std::move(kernel), std::move(scene), settings.threads);
  prepared.build_seconds_ = seconds_since(start);
  return prepared;
}

}  // namespace sdlc::render
