#include "tests/extremes/cases.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "tests/support/statistics/scenes.hpp"

namespace sdlc::test {
namespace {

using render::Fresnel;
using render::LinearRgb;
using render::Material;
using render::Scene;
using render::Vec3;

constexpr LinearRgb kWhite{1};
constexpr LinearRgb kBlack{};

/// All pixels see the same except for squares of their angle, 1e-8; and each is still wide enough
/// for float.
Scene beam(Vec3 from, Vec3 at, LinearRgb sky) {
  Scene scene = beam_scene(from, at, sky);
  scene.camera.plane_height = 2e-4;
  return scene;
}

Scene gradient_beam(Vec3 from, Vec3 at) {
  Scene scene = beam(from, at, kWhite);
  scene.background = {};
  return scene;
}

double schlick(double cosine, double n) {
  const double root = (n - 1) / (n + 1), straight = root * root;
  return straight + (1 - straight) * std::pow(1 - cosine, 5);
}

double fresnel(double cosine, double beyond, double n) {
  const double across = (cosine - n * beyond) / (cosine + n * beyond);
  const double along = (n * cosine - beyond) / (n * cosine + beyond);
  return (across * across + along * along) / 2;
}

/// A ray that hits glass at impact parameter b is reflected with R_o, or enters, and then hits the
/// surface from inside at a constant angle forever.
double glass(double n, double b, double c, Fresnel kind = Fresnel::Schlick) {
  const double outer_cosine = std::sqrt(1 - b * b), sine = b / n;
  if (sine >= 1) return c;  // total reflection
  const double inner_cosine = std::sqrt(1 - sine * sine);
  const double outer =
      kind == Fresnel::Exact ? fresnel(outer_cosine, inner_cosine, n) : schlick(outer_cosine, n);
  // From inside, the model also uses Schlick's approximation at the inner angle.
  const double inner = kind == Fresnel::Exact ? outer
                       : n * std::sqrt(1 - inner_cosine * inner_cosine) > 1
                           ? 1
                           : schlick(inner_cosine, n);
  return outer * c + (1 - outer) * c * c * (1 - inner) / (1 - c * inner);
}

/// Along the axis of concentric surfaces: each of the 2 n hits reflects a share r and multiplies by
/// c. The light that returns or passes from a sky of 1, by iteration to its fixed point.
double slabs(int surfaces, double r, double c) {
  const auto n = static_cast<std::size_t>(surfaces);
  std::vector<double> right(n + 2, 1), left(n + 2, 1);  // arriving at a surface, by direction
  for (int step = 0; step < 4000; ++step) {
    for (std::size_t i = 1; i <= n; ++i) {
      right[i] = c * ((1 - r) * right[i + 1] + r * left[i - 1]);
      left[i] = c * ((1 - r) * left[i - 1] + r * right[i + 1]);
    }
  }
  return right[1];
}

ExtremeCase lone_diffuse() {
  ExtremeCase all{"lone diffuse sphere under a white sky: its albedo; depth 1: 0", {}};
  const LinearRgb a{0.8, 0.5, 0.1};
  for (const int depth : {1, 2, 3, 50}) {
    Scene scene = beam({0, 0, 5}, {0.3, 0.2, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
    all.variants.push_back({fmt::format("depth {}", depth), scene, depth, depth == 1 ? kBlack : a});
  }
  for (const double radius : {1e-30, 1e-6, 1e6, 1e30}) {
    Scene scene = beam(Vec3{0, 0, 5} * radius, Vec3{0.3, 0.2, 0} * radius, kWhite);
    add_sphere(scene, {0, 0, 0}, radius, diffuse(a));
    all.variants.push_back({fmt::format("radius {:g}", radius), scene, 2, a});
  }
  for (const double distance : {1e-3, 1e-6, 1e3, 1e6, 1e9}) {
    Scene scene = beam({0, 0, 1 + distance}, {0, 0, 0}, kWhite);
    scene.camera.plane_height = std::min(2e-4, 0.2 / distance);
    add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
    all.variants.push_back({fmt::format("camera {:g} radii away", distance), scene, 2, a});
  }
  return all;
}

// Under the gradient 1 − t(1 − g), t = (1 + y) / 2, the cosine law gives E[t] = 1/2 + n_y / 3.
ExtremeCase gradient_on_diffuse() {
  ExtremeCase all{"gradient sky on a diffuse sphere: a[1 − T(1 − g)], T = 1/2 + n_y / 3", {}};
  for (const double latitude : {90.0, 40.0, 0.0, -65.0, -90.0}) {
    const double radians = latitude * M_PI / 180;
    const Vec3 normal{0, std::sin(radians), std::fabs(latitude) == 90 ? 0 : std::cos(radians)};
    Scene scene = gradient_beam(normal * 4, {0, 0, 0});
    const LinearRgb a{0.9, 0.6, 0.3}, g = scene.background.top;
    add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
    const double t = 0.5 + normal.y / 3;
    all.variants.push_back(
        {fmt::format("latitude {}°", latitude), scene, 16, a * (kWhite - (kWhite - g) * t)});
  }
  return all;
}

ExtremeCase gradient_ends() {
  ExtremeCase all{"gradient sky straight up (.5, .7, 1) and down 1", {}};
  const auto look = [&](const char* what, Vec3 at, LinearRgb expected) {
    Scene scene = gradient_beam({0, 0, 0}, at);
    scene.camera.plane_height = 1e-6;
    add_sphere(scene, {1000, 0, 0}, 1, diffuse(kWhite));  // out of sight
    all.variants.push_back({what, scene, 4, expected, 16});
  };
  look("up", {0, 1, 0}, {0.5, 0.7, 1});
  look("down", {0, -1, 0}, kWhite);
  look("level", {0, 0, -1}, {0.75, 0.85, 1});
  return all;
}

ExtremeCase emissive_shell() {
  ExtremeCase all{"diffuse inside an emissive shell: aL", {}};
  const LinearRgb a{0.7, 0.4, 0.9};
  for (const auto& [radius, intensity] : {std::pair{30.0, 3.0}, {1e6, 1e-20}, {4.9, 1e20}}) {
    Scene scene = beam({0, 0, 4}, {0.5, 0.1, 0}, kBlack);
    add_sphere(scene, {0, 0, 0}, 1, diffuse(a));
    add_sphere(scene, {radius / 50, 0, 0}, radius, emissive({0.5, 1, 2}, intensity));
    all.variants.push_back({fmt::format("shell of radius {:g}, L = {:g}", radius, intensity), scene,
                            2, a * LinearRgb{0.5, 1, 2} * intensity});
  }
  return all;
}

// Of the light that leaves a point of the shell by the cosine law, F = ρ² hits the emitter; the
// rest hits the shell again under the same conditions.
ExtremeCase concentric_emitter() {
  ExtremeCase all{
      "emitter inside a concentric diffuse shell, ratio ρ, F = ρ²: "
      "aFL(1 − (a(1 − F))^(D − 1)) / (1 − a(1 − F))",
      {}};
  const auto add = [&](double a, double rho, double l, int depth, int samples) {
    Scene scene = beam({0, 0, 2 * (0.5 + rho / 2)}, {0, 0.3, 2}, kBlack);
    add_sphere(scene, {0, 0, 0}, 2, diffuse(LinearRgb{a}));
    add_sphere(scene, {0, 0, 0}, 2 * rho, emissive(kWhite, l));
    const double f = rho * rho, q = a * (1 - f);
    const double expected = a * f * l * (1 - std::pow(q, depth - 1)) / (1 - q);
    all.variants.push_back({fmt::format("a = {}, ρ = {}, D = {}", a, rho, depth), scene, depth,
                            LinearRgb{expected}, samples});
  };
  for (const int depth : {2, 3, 6, 40}) add(0.8, 0.6, 2, depth, 128);
  add(1, 0.3, 1, 30, 64);
  add(0.95, 0.97, 1, 8, 64);
  add(0.5, 0.05, 100, 12, 128);
  return all;
}

// Irradiance from a sphere of radius R at distance d, completely above the horizon: π L cos θ (R /
// d)².
ExtremeCase sphere_light() {
  ExtremeCase all{"sphere light of radius R at distance d on diffuse: aL cos θ (R / d)²", {}};
  const auto add = [&](double ground, double theta, double radius, double distance) {
    const double a = 0.7, share = std::cos(theta) * radius * radius / (distance * distance);
    Scene scene = beam({0, 3, 2}, {0, 0, 0}, kBlack);
    add_sphere(scene, {0, -ground, 0}, ground, diffuse(LinearRgb{a}));  // its top is the origin
    const Vec3 light = Vec3{std::sin(theta), std::cos(theta), 0} * distance;
    add_sphere(scene, light, radius, emissive(kWhite, 1 / share));
    all.variants.push_back(
        {fmt::format("θ = {}, R = {}, d = {}, ground of {:g}", theta, radius, distance, ground),
         scene, 2, LinearRgb{a}, 256});
  };
  add(100, 0.6, 0.5, 4);
  add(100, 0, 0.2, 4);
  add(5000, 0.6, 0.5, 4);  // computed in double, the light in float
  add(1e5, 1.2, 0.5, 6);
  add(6.371e6, 0.3, 0.1, 1);
  return all;
}

ExtremeCase centre_of_glass() {
  ExtremeCase all{"camera at the centre of glass: c(1 − R)(1 − (cR)^(D − 1)) / (1 − cR)", {}};
  const auto add = [&](double n, double c, int depth, double radius) {
    const double r = schlick(1, n);
    Scene scene = beam({0, 0, 0}, {0, 0, -1}, kWhite);
    add_sphere(scene, {0, 0, 0}, radius, transmissive(LinearRgb{c}, n));
    const double expected = c * (1 - r) * (1 - std::pow(c * r, depth - 1)) / (1 - c * r);
    all.variants.push_back({fmt::format("ior {}, c = {}, D = {}, radius {:g}", n, c, depth, radius),
                            scene, depth, LinearRgb{expected}});
  };
  for (const int depth : {1, 2, 3, 50, 1'000'000}) add(1.5, 0.5, depth, 1);
  add(2.4, 0.9, 100, 1e-12);
  add(10, 1, 4, 1);
  add(1.0001, 1, 20, 1e12);
  add(0.1, 0.7, 1'000'000, 1);
  return all;
}

ExtremeCase glass_at_impact() {
  ExtremeCase all{"glass at impact parameter b: R_o c + (1 − R_o)c²(1 − R_i) / (1 − cR_i)", {}};
  const auto add = [&](double n, double b, double c, double radius, Fresnel kind, int depth = 60,
                       int samples = 256) {
    Scene scene = beam(Vec3{b, 0, 5} * radius, Vec3{b, 0, 0} * radius, kWhite);
    add_sphere(scene, {0, 0, 0}, radius, transmissive(LinearRgb{c}, n, kind));
    all.variants.push_back({fmt::format("ior {}, b = {}, c = {}, radius {:g}{}", n, b, c, radius,
                                        kind == Fresnel::Exact ? ", Fresnel's equations" : ""),
                            scene, depth, LinearRgb{glass(n, b, c, kind)}, samples});
  };
  for (const double b : {0.0, 0.5, 0.9, 0.99}) add(1.5, b, 0.5, 1, Fresnel::Schlick);
  for (const double b : {0.0, 0.3, 0.8, 0.95}) add(1.5, b, 0.5, 1, Fresnel::Exact);
  for (const double n : {1.01, 1.33, 2.4, 5.0}) {
    add(n, 0.6, 0.7, 1, Fresnel::Schlick);
    add(n, 0.6, 0.7, 1, Fresnel::Exact);
  }
  for (const double radius : {1e-5, 1e-8, 1e-100, 1e150})
    add(1.5, 0, 0.5, radius, Fresnel::Schlick);
  // About ten of these paths enter.
  add(1e6, 0.3, 0.8, 1, Fresnel::Exact, 60, 1 << 14);
  for (const double n : {1e-320, 1e-300, 1e-20, 1e20, 1e300}) {
    for (const Fresnel kind : {Fresnel::Schlick, Fresnel::Exact}) {
      // Everything is reflected, except for one part in the index.
      Scene scene = beam({0, 0, 5}, {0, 0, 0}, kWhite);
      scene.camera.plane_height = 1e-100;
      add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{0.5}, n, kind));
      all.variants.push_back({fmt::format("ior {:g} straight on{}", n,
                                          kind == Fresnel::Exact ? ", Fresnel's equations" : ""),
                              scene, 60, LinearRgb{0.5}, 16});
    }
  }
  // ior 1: nothing is refracted, but Schlick's approximation still reflects.
  add(1, std::sqrt(0.99), 0.5, 1, Fresnel::Schlick);
  add(1, 0.9, 0.5, 1, Fresnel::Exact);
  return all;
}

ExtremeCase total_reflection() {
  ExtremeCase all{"total reflection from outside, ior below 1: c", {}};
  for (const auto& [n, b] :
       {std::pair{0.5, 0.7}, {0.1, 0.2}, {0.9, 0.95}, {1e-6, 0.5}, {1e-300, 0.5}, {1e-320, 0.5}}) {
    Scene scene = beam({b, 0, 5}, {b, 0, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{0.5}, n));
    all.variants.push_back({fmt::format("ior {}, b = {}", n, b), scene, 16, LinearRgb{0.5}, 64});
  }
  return all;
}

// The camera is at distance x from the centre and looks perpendicularly to it: the sine of the
// angle at the surface stays x forever.
ExtremeCase critical_angle() {
  ExtremeCase all{"inside white glass beyond the critical angle 0, below it 1", {}};
  for (const auto& [n, x] :
       {std::pair{1.5, 0.9}, {1.5, 0.68}, {2.4, 0.43}, {1.5, 0.6}, {1.1, 0.8}}) {
    Scene scene = beam({x, 0, 0}, {x, 1, 0}, kWhite);
    scene.camera.up = {1, 0, 0};
    add_sphere(scene, {0, 0, 0}, 1, transmissive(kWhite, n));
    all.variants.push_back(
        {fmt::format("ior {}, sine {}", n, x), scene, 2000, n * x > 1 ? kBlack : kWhite, 16});
  }
  return all;
}

// The end of the mirrored unit vector is perturbed within a ball of radius f; the cap below the
// surface is absorbed.
ExtremeCase fuzzy_mirror() {
  ExtremeCase all{"mirror of fuzz f at cosine c: 1 − (2 − 3s + s³) / 4, s = min(1, c / f)", {}};
  for (const auto& [fuzz, cosine] : {std::pair{0.5, 0.2},
                                     {0.5, 0.9},
                                     {1.0, 0.3},
                                     {2.5, 0.6},
                                     {1e-6, 0.4},
                                     {1e6, 0.5},
                                     {1e20, 0.5}}) {
    const double sine = std::sqrt(1 - cosine * cosine);
    Scene scene = beam({sine * 3, 1 + cosine * 3, 0}, {0, 1, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, specular(LinearRgb{0.9}, fuzz));
    const double s = std::min(1.0, cosine / fuzz);
    const double survives = 1 - (2 - 3 * s + s * s * s) / 4;
    all.variants.push_back(
        {fmt::format("f = {:g}, c = {}", fuzz, cosine), scene, 16, LinearRgb{0.9 * survives}});
  }
  return all;
}

ExtremeCase closed_room() {
  ExtremeCase all{"camera inside a closed diffuse or mirror sphere: 0", {}};
  const std::pair<const char*, Material> walls[] = {{"diffuse", diffuse(kWhite)},
                                                    {"mirror", specular(kWhite, 0)},
                                                    {"fuzzy mirror", specular(kWhite, 0.3)}};
  for (const auto& [name, wall] : walls) {
    for (const double radius : {1e-9, 1.0, 1e9}) {
      Scene scene = beam(Vec3{0.2, 0.1, 0} * radius, Vec3{1, 0.3, -1} * radius, kWhite);
      add_sphere(scene, {0, 0, 0}, radius, wall);
      all.variants.push_back({fmt::format("{}, radius {:g}", name, radius), scene, 200, kBlack, 8});
    }
  }
  return all;
}

ExtremeCase huge_ground() {
  ExtremeCase all{"white ground under a white sky: 1", {}};
  for (const double radius : {1e3, 1e6, 6.371e6, 1e9, 1e12}) {
    for (const double slope : {1.0, 0.02}) {
      Scene scene = beam({0, 1, 0}, {1, 1 - slope, 0}, kWhite);
      add_sphere(scene, {0, -radius, 0}, radius, diffuse(kWhite));
      all.variants.push_back(
          {fmt::format("radius {:g}, slope {}", radius, slope), scene, 50, kWhite, 16});
    }
  }
  // A camera just above the ground, and another sphere large enough that only the ground is
  // computed in double: the distance to the ground is a thousand-millionth of the way through it.
  for (const double height : {10.0, 1e-2, 1e-5}) {
    Scene scene = beam({0, height, 0}, {0.3 * height, 0, 0}, kWhite);
    add_sphere(scene, {0, -1e6, 0}, 1e6, diffuse(kWhite));
    add_sphere(scene, {3e4, 1e4, 0}, 1e4, diffuse(kWhite));
    all.variants.push_back(
        {fmt::format("radius 1e6, from {:g} above", height), scene, 1000, kWhite, 16});
  }
  // With a small sphere on it, so that one is small compared with the other.
  for (const double radius : {1e3, 1e4, 6.371e6, 1e9}) {
    Scene scene = beam({0, 1, 3}, {0, 0, 0.12}, kWhite);
    add_sphere(scene, {0, -radius, 0}, radius, diffuse(kWhite));
    add_sphere(scene, {0, 0.1, 0}, 0.1, diffuse(kWhite));
    all.variants.push_back(
        {fmt::format("radius {:g}, a sphere of .1 on it", radius), scene, 1000, kWhite, 16});
  }
  return all;
}

ExtremeCase nested_shells() {
  ExtremeCase all{"nested shells of ior 1, c = 1, central rays: 1", {}};
  for (const int count : {1, 8, 64, 250}) {
    Scene scene = beam({0.05, 0, 5}, {0.05, 0, 0}, kWhite);
    for (int i = 0; i < count; ++i) {
      add_sphere(scene, {0, 0, 0}, 1 - 0.8 * i / count, transmissive(kWhite, 1));
    }
    all.variants.push_back({fmt::format("{} shells", count), scene, 20 * count + 100, kWhite, 4});
  }
  return all;
}

ExtremeCase bubbles() {
  ExtremeCase all{"glass shells along their axis: the series of all reflections", {}};
  for (const double gap : {0.1, 0.01, 1e-3, 1e-6, 1e-9}) {
    for (const double c : {0.5, 0.9}) {
      Scene scene = beam({0, 0, 4}, {0, 0, 0}, kWhite);
      add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{c}, 1.5));
      add_sphere(scene, {0, 0, 0}, 1 - gap, transmissive(LinearRgb{c}, 1 / 1.5));
      all.variants.push_back({fmt::format("gap {:g}, c = {}", gap, c), scene, 400,
                              LinearRgb{slabs(4, schlick(1, 1.5), c)}});
    }
  }
  // Far away, where even a shell that float resolves at close range is too thin.
  for (const double distance : {100.0, 3000.0}) {
    Scene scene = beam({0, 0, distance}, {0, 0, 0}, kWhite);
    scene.camera.plane_height = 0.1 / distance;
    add_sphere(scene, {0, 0, 0}, 1, transmissive(LinearRgb{0.5}, 1.5));
    add_sphere(scene, {0, 0, 0}, 1 - 1e-4, transmissive(LinearRgb{0.5}, 1 / 1.5));
    all.variants.push_back({fmt::format("gap 1e-4, {} radii away", distance), scene, 400,
                            LinearRgb{slabs(4, schlick(1, 1.5), 0.5)}});
  }
  for (const int pairs : {4, 30}) {
    Scene scene = beam({0, 0, 4}, {0, 0, 0}, kWhite);
    for (int i = 0; i < pairs; ++i) {
      const double radius = 1 - 0.9 * i / pairs;
      add_sphere(scene, {0, 0, 0}, radius, transmissive(LinearRgb{0.98}, 1.5));
      add_sphere(scene, {0, 0, 0}, radius - 0.4 / pairs, transmissive(LinearRgb{0.98}, 1 / 1.5));
    }
    all.variants.push_back({fmt::format("{} glass shells, c = 0.98", pairs), scene, 4000,
                            LinearRgb{slabs(4 * pairs, schlick(1, 1.5), 0.98)}, 16});
  }
  return all;
}

ExtremeCase many_spheres() {
  ExtremeCase all{"many spheres: 1", {}};
  Scene nested = beam({0.05, 0, 5}, {0.05, 0, 0}, kWhite);
  for (int i = 0; i < 400; ++i) {
    add_sphere(nested, {0, 0, 0}, 1 - 0.8 * i / 400, transmissive(kWhite, 1));
  }
  all.variants.push_back({"400 nested shells of ior 1", nested, 8000, kWhite, 1});
  Scene field = beam({0, 3, 9}, {0, 0, 0}, kWhite);
  field.camera.plane_height = 0.6;
  add_sphere(field, {0, -6.371e6 - 0.1, 0}, 6.371e6, diffuse(kWhite));
  for (int i = 0; i < 900; ++i) {
    const Vec3 center{0.25 * (i % 30 - 15), 0, 0.25 * (i / 30 - 15)};
    add_sphere(field, center, 0.1, i % 3 == 0 ? specular(kWhite, 0) : diffuse(kWhite));
  }
  all.variants.push_back({"900 white spheres on a ground of 6.371e6", field, 4000, kWhite, 16});
  return all;
}

ExtremeCase white_glass() {
  ExtremeCase all{"white glass, hollow or not, under a white sky: 1", {}};
  for (const double gap : {0.0, 0.3, 1e-2, 1e-5, 1e-9}) {
    Scene scene = beam({0.4, 0.3, 5}, {0.4, 0.3, 0}, kWhite);
    add_sphere(scene, {0, 0, 0}, 1, transmissive(kWhite, 1.5));
    if (gap > 0) add_sphere(scene, {0, 0, 0}, 1 - gap, transmissive(kWhite, 1 / 1.5));
    all.variants.push_back(
        {gap > 0 ? fmt::format("wall {:g}", gap) : "solid", scene, 10000, kWhite, 16});
  }
  return all;
}

// Within √(2 e R) of a contact, R = 1 / (1 / r₁ ± 1 / r₂), surfaces are nearer to each other than
// the error e of points; the camera sees almost only this region.
ExtremeCase contacts() {
  ExtremeCase all{"white surfaces that touch, under a white sky: 1", {}};
  const auto add = [&](const char* what, double ground, const Material& ball, double height,
                       double degrees, double sunk = 0) {
    Scene scene = beam({0, height, 0}, {0, 0, 0}, kWhite);
    scene.camera.up = {1, 0, 0};
    scene.camera.plane_height = 2 * std::tan(degrees / 2 * M_PI / 180);
    add_sphere(scene, {0, -ground, 0}, std::fabs(ground),
               ground > 0 ? diffuse(kWhite) : emissive(kWhite, 1));
    add_sphere(scene, {0, 1 - sunk, 0}, 1, ball);
    all.variants.push_back({what, scene, 1'000'000, kWhite, sunk == 0 ? 64 : 16});
    return &all.variants.back().scene;
  };
  const Material glass = transmissive(kWhite, 1.5);
  add("glass on a ground of 5", 5, glass, 20, 0.02);
  add("glass on a ground of 100", 100, glass, 10, 1);
  add("glass on a ground of 100, from near", 100, glass, 3, 0.02);
  add("glass on a ground of 1e4", 1e4, glass, 10, 0.02);
  add("glass on a ground of 6.371e6", 6.371e6, glass, 10, 0.02);
  add("glass on a ground of 1e9", 1e9, glass, 10, 0.02);
  add("glass a millionth in a ground of 5", 5, glass, 20, 0.02, 1e-6);
  add("glass a millionth above a ground of 5", 5, glass, 20, 0.02, -1e-6);
  add("glass in a bright hollow of 30", -30, glass, 5, 0.02);
  add_sphere(*add("diffuse in glass", 50, glass, 20, 0.02), {0, 0.5, 0}, 0.5, diffuse(kWhite));
  add_sphere(*add("glass in glass", 50, glass, 20, 0.02), {0, 0.5, 0}, 0.5, glass);
  add_sphere(*add("glass below glass", 50, glass, 20, 0.02), {0, 2.5, 0}, 0.5, glass);
  return all;
}

// Light that leaves the centre of a huge mirror returns to it.
ExtremeCase gathering_mirror() {
  ExtremeCase all{"camera and lamp beside the middle of a huge mirror: the lamp's light", {}};
  for (const double radius : {1e3, 1e5, 1e6}) {
    for (const double lamp : {0.05, 0.005}) {
      Scene scene = beam({1, 0, 0}, {2, 0, 0}, kBlack);
      scene.camera.plane_height = 2e-4;
      add_sphere(scene, {0, 0, 0}, radius, specular(LinearRgb{0.8}, 0));
      add_sphere(scene, {-1, 0, 0}, lamp, emissive(kWhite, 0.5));
      all.variants.push_back({fmt::format("mirror of {:g}, lamp of {:g}", radius, lamp), scene, 2,
                              LinearRgb{0.4}, 16});
    }
  }
  return all;
}

ExtremeCase on_a_surface() {
  ExtremeCase all{"camera on the surface looking out: the sky; looking in: the far side", {}};
  for (const double radius : {1e-12, 1e-6, 1.0, 6.371e6, 1e12}) {
    Scene scene = beam({0, radius, 0}, {0.3 * radius, 1.2 * radius, 0}, LinearRgb{0.25});
    add_sphere(scene, {0, 0, 0}, radius, unlit(LinearRgb{0.75}));
    all.variants.push_back(
        {fmt::format("out, radius {:g}", radius), scene, 16, LinearRgb{0.25}, 16});
    scene.camera.at = {0.1 * radius, 0, 0};
    all.variants.push_back(
        {fmt::format("in, radius {:g}", radius), scene, 16, LinearRgb{0.75}, 16});
  }
  // Where no number is exactly on the surface.
  const Vec3 normal = unit(Vec3{0.3, 0.5, -0.7});
  for (const double offset : {0.0, 1e3, 1e7}) {
    const Vec3 center{offset, -offset, offset};
    Scene scene = beam(center + normal * 3.1, center + normal * 5, LinearRgb{0.25});
    add_sphere(scene, center, 3.1, diffuse(LinearRgb{0.5}));
    if (offset < 1e5) {
      all.variants.push_back(
          {fmt::format("out at an angle, offset {:g}", offset), scene, 16, LinearRgb{0.25}, 16});
    }
  }
  return all;
}

ExtremeCase on_several_surfaces() {
  ExtremeCase all{"camera where several spheres touch", {}};
  const auto touching = [](Vec3 at) {
    Scene scene = beam({0, 0, 0}, at, LinearRgb{0.25});
    add_sphere(scene, {0, -3, 0}, 3, unlit(LinearRgb{0.9}));
    add_sphere(scene, {0, 1, 0}, 1, unlit(LinearRgb{0.5}));
    add_sphere(scene, {0, 7, 0}, 7, unlit(LinearRgb{0.7}));  // around the second
    return scene;
  };
  all.variants.push_back({"into the inner one", touching({0, 1, 0.1}), 16, LinearRgb{0.5}, 16});
  all.variants.push_back({"down", touching({0.2, -1, 0}), 16, LinearRgb{0.9}, 16});
  return all;
}

ExtremeCase radius_zero() {
  ExtremeCase all{"radius 0: the sky", {}};
  Scene scene = beam({0, 0, 5}, {0, 0, 0}, LinearRgb{0.3});
  add_sphere(scene, {0, 0, 0}, 0, diffuse(kWhite));
  add_sphere(scene, {9, 0, 0}, 1, diffuse(kWhite));
  all.variants.push_back({"in front of nothing", scene, 16, LinearRgb{0.3}, 16});
  return all;
}

ExtremeCase movement() {
  ExtremeCase all{"sphere that moves from x = −2 to 2 in [0, 1], r = 1: its share of the shutter",
                  {}};
  const auto add = [&](double from, double to, double share) {
    Scene scene = beam({0, 0, 5}, {0, 0, 0}, kBlack);
    add_sphere(scene, {-2 + 4 * from, 0, 0}, 1, unlit(kWhite));
    scene.shifts = {{4 * (to - from), 0, 0}};
    all.variants.push_back(
        {fmt::format("shutter [{}, {}]", from, to), scene, 1, LinearRgb{share}, 256});
  };
  add(0, 1, 0.5);
  add(0.5, 0.5, 1);
  add(1, 3, 0);
  add(-1, 0, 0);
  add(0, 0.5, 0.5);
  add(0, 100, 0.005);
  add(1, 0, 0.5);
  add(-10, 10, 0.025);
  add(0.3, 0.7, 1);
  // Another sphere blocks the first half.
  Scene scene = beam({0, 0, 5}, {0, 0, 0}, kBlack);
  add_sphere(scene, {-2, 0, 0}, 1, unlit(kWhite));
  add_sphere(scene, {-0.5, 0, 2}, 0.5, unlit(LinearRgb{0.5}));
  scene.shifts = {{4, 0, 0}, {2, 0, 0}};  // covers the axis up to t = 1/2
  all.variants.push_back(
      {"half hidden by another", scene, 1, LinearRgb{0.25 * 1 + 0.5 * 0.5}, 256});
  return all;
}

ExtremeCase colors() {
  ExtremeCase all{"colours far from 1", {}};
  const auto add = [&](const char* what, const Material& material, LinearRgb sky,
                       LinearRgb expected, int depth = 16) {
    Scene scene = beam({0, 0, 5}, {0.2, 0, 0}, sky);
    add_sphere(scene, {0, 0, 0}, 1, material);
    all.variants.push_back({what, scene, depth, expected, 64});
  };
  add("albedo 2", diffuse(LinearRgb{2}), kWhite, LinearRgb{2});
  add("albedo 1e-310", diffuse(LinearRgb{1e-310}), kWhite, LinearRgb{1e-310});
  add("albedo 1e-40", diffuse(LinearRgb{1e-40}), LinearRgb{1e20}, LinearRgb{1e-20});
  add("albedo 1e30 under 1e30", diffuse(LinearRgb{1e30}), LinearRgb{1e30}, LinearRgb{1e60});
  add("intensity 1e300", emissive(kWhite, 1e300), kBlack, LinearRgb{1e300});
  add("black and no emitter", diffuse(kWhite), kBlack, kBlack);
  return all;
}

ExtremeCase views() {
  ExtremeCase all{"views of any angle", {}};
  const auto add = [&](const char* what, double plane_height, double aspect, LinearRgb expected) {
    Scene scene = beam({0, 0, 5}, {0, 0, 0}, kWhite);
    scene.camera.plane_height = plane_height;
    scene.camera.aspect = aspect;
    add_sphere(scene, {0, 0, 0}, 1, unlit(LinearRgb{0.5}));
    all.variants.push_back({what, scene, 4, expected, 64});
  };
  add("vfov 1e-6°", 2 * std::tan(0.5e-6 * M_PI / 180), 1, LinearRgb{0.5});
  add("vfov 1e-12°", 2 * std::tan(0.5e-12 * M_PI / 180), 1, LinearRgb{0.5});
  // The sphere is a millionth of a pixel: only the sky is visible.
  add("vfov 179.999°", 2 * std::tan(0.5 * 179.999 * M_PI / 180), 1, kWhite);
  add("vfov 179.9999999°", 2 * std::tan(0.5 * 179.9999999 * M_PI / 180), 1, kWhite);
  add("vfov 1e-3°, aspect 1e6", 2 * std::tan(0.5e-3 * M_PI / 180), 1e-3, LinearRgb{0.5});
  return all;
}

}  // namespace

const std::vector<ExtremeCase>& extreme_cases() {
  static const std::vector<ExtremeCase> all{lone_diffuse(),
                                            gradient_on_diffuse(),
                                            gradient_ends(),
                                            emissive_shell(),
                                            concentric_emitter(),
                                            sphere_light(),
                                            centre_of_glass(),
                                            glass_at_impact(),
                                            total_reflection(),
                                            critical_angle(),
                                            fuzzy_mirror(),
                                            closed_room(),
                                            huge_ground(),
                                            nested_shells(),
                                            bubbles(),
                                            many_spheres(),
                                            white_glass(),
                                            contacts(),
                                            gathering_mirror(),
                                            on_a_surface(),
                                            on_several_surfaces(),
                                            radius_zero(),
                                            movement(),
                                            colors(),
                                            views()};
  return all;
}

render::RenderSettings settings_of(const ExtremeVariant& variant) {
  return {.width = 16,
          .height = 16,
          .samples = variant.samples,
          .depth = variant.depth,
          .seed = 7,
          .threads = 2,
          // Standard errors assume independent samples.
          .sampler = render::SamplerKind::Independent};
}

Measured measure(const ExtremeVariant& variant, const Form& form) {
  Measured measured{{}, render_in(form, variant.scene, settings_of(variant))};
  EstimateBuilder builder;
  for (const LinearRgb& pixel : measured.result.picture.pixels) builder.add(pixel);
  measured.estimate = builder.estimate();
  return measured;
}

}  // namespace sdlc::test
