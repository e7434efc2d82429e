#include "render/scene/digest.hpp"

#include <bit>
#include <cstdint>
#include <vector>

#include "render/math/color.hpp"
#include "render/math/fnv.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::render {
namespace {

class Hash {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) hash_.add_byte(static_cast<std::uint8_t>(word >> 8 * i));
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(Vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(LinearRgb c) { add(c.r), add(c.g), add(c.b); }
  void add(const std::vector<Sphere>& spheres) {
    for (const Sphere& sphere : spheres) {
      add(sphere.center);
      add(sphere.radius);
      add(std::uint64_t{sphere.material});
    }
  }
  std::uint64_t value() const { return hash_.value(); }

 private:
  Fnv1a hash_;
};

void add_motion_and_instances(const Scene& scene, Hash& hash) {
  for (const Vec3 shift : scene.shifts) hash.add(shift);
  for (const Prototype& prototype : scene.prototypes) {
    hash.add(prototype.spheres);
    for (const Vec3 shift : prototype.shifts) hash.add(shift);
  }
  for (const Instance& instance : scene.instances) {
    hash.add(std::uint64_t{instance.prototype});
    const Placement& placement = instance.placement;
    for (const Vec3 v : {placement.x, placement.y, placement.z, placement.translate}) hash.add(v);
    hash.add(placement.scale);
    hash.add(instance.shift);
  }
}

void add(const std::vector<Material>& materials, Hash& hash) {
  for (const Material& material : materials) {
    hash.add(material.color);
    hash.add(material.parameter);
    hash.add(static_cast<std::uint64_t>(material.type) * 2 +
             static_cast<std::uint64_t>(material.fresnel));
  }
}

void add(const Camera& camera, Hash& hash) {
  for (const Vec3 v : {camera.from, camera.at, camera.up}) hash.add(v);
  hash.add(camera.plane_height);
  hash.add(camera.aspect);
  if (camera.has_lens()) {
    hash.add(camera.aperture);
    hash.add(camera.focus);
  }
}

void add(const Background& background, Hash& hash) {
  hash.add(background.bottom);
  hash.add(background.top);
}

template <typename Add>
Digest digest(Add add) {
  Hash hash;
  add(hash);
  return Digest{hash.value()};
}

}  // namespace

std::uint64_t digest_of(const Scene& scene) {
  Hash hash;
  hash.add(scene.spheres);
  add(scene.materials, hash);
  add_motion_and_instances(scene, hash);
  add(scene.camera, hash);
  add(scene.background, hash);
  return hash.value();
}

SceneDigest digest_of_parts(const Scene& scene) {
  const auto add_spheres = [&](Hash& hash) {
    hash.add(scene.spheres);
    add_motion_and_instances(scene, hash);
  };
  return {.spheres = digest(add_spheres),
          .materials = digest([&](Hash& hash) { add(scene.materials, hash); }),
          .camera = digest([&](Hash& hash) { add(scene.camera, hash); }),
          .background = digest([&](Hash& hash) { add(scene.background, hash); })};
}

}  // namespace sdlc::render
