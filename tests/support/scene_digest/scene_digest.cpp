#include "tests/support/scene_digest/scene_digest.hpp"

#include <bit>

#include "render/math/color.hpp"
#include "render/math/vec3.hpp"

namespace sdlc::test {
namespace {

class Digest {
 public:
  void add(std::uint64_t word) {
    for (int i = 0; i < 8; ++i) {
      hash_ = (hash_ ^ (word >> 8 * i & 0xFF)) * 0x100000001B3u;
    }
  }
  void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
  void add(render::Vec3 v) { add(v.x), add(v.y), add(v.z); }
  void add(render::LinearRgb c) { add(c.r), add(c.g), add(c.b); }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xCBF29CE484222325u;
};

}  // namespace

std::uint64_t digest_of(const render::Scene& scene) {
  Digest digest;
  for (const render::Sphere& sphere : scene.spheres) {
    digest.add(sphere.center);
    digest.add(sphere.radius);
    digest.add(std::uint64_t{sphere.material});
  }
  for (const render::Material& material : scene.materials) {
    digest.add(material.color);
    digest.add(material.parameter);
    digest.add(static_cast<std::uint64_t>(material.type) * 2 +
               static_cast<std::uint64_t>(material.fresnel));
  }
  for (const render::Vec3 shift : scene.shifts) digest.add(shift);
  digest.add(scene.camera.from);
  digest.add(scene.camera.at);
  digest.add(scene.camera.up);
  digest.add(scene.camera.plane_height);
  digest.add(scene.camera.aspect);
  digest.add(scene.background.bottom);
  digest.add(scene.background.top);
  return digest.value();
}

}  // namespace sdlc::test
