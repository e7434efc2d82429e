#include "render/scene/digest.hpp"

#include <bit>
#include <cstdint>
#include <vector>

#include "render/math/color.hpp"
#include "render/math/fnv.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::render {
namespace {

class Digest {
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

}  // namespace

std::uint64_t digest_of(const Scene& scene) {
  Digest digest;
  digest.add(scene.spheres);
  for (const Material& material : scene.materials) {
    digest.add(material.color);
    digest.add(material.parameter);
    digest.add(static_cast<std::uint64_t>(material.type) * 2 +
               static_cast<std::uint64_t>(material.fresnel));
  }
  for (const Vec3 shift : scene.shifts) digest.add(shift);
  for (const Prototype& prototype : scene.prototypes) {
    digest.add(prototype.spheres);
    for (const Vec3 shift : prototype.shifts) digest.add(shift);
  }
  for (const Instance& instance : scene.instances) {
    digest.add(std::uint64_t{instance.prototype});
    const Placement& placement = instance.placement;
    for (const Vec3 v : {placement.x, placement.y, placement.z, placement.translate}) digest.add(v);
    digest.add(placement.scale);
    digest.add(instance.shift);
  }
  digest.add(scene.camera.from);
  digest.add(scene.camera.at);
  digest.add(scene.camera.up);
  digest.add(scene.camera.plane_height);
  digest.add(scene.camera.aspect);
  if (scene.camera.has_lens()) {
    digest.add(scene.camera.aperture);
    digest.add(scene.camera.focus);
  }
  digest.add(scene.background.bottom);
  digest.add(scene.background.top);
  return digest.value();
}

}  // namespace sdlc::render
