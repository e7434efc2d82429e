#include "bench/sphere_field.hpp"

#include <cmath>
#include <iterator>
#include <random>
#include <string_view>

#include <fmt/format.h>

namespace sdlc::bench {
namespace {

constexpr std::size_t kBytesPerSphere = 160;  // upper bound: reallocation would count in the peak

enum class Kind { Matt, Metal, Glass };

struct FieldSphere {
  double x, y, z, radius;
  Kind kind;
  int red, green, blue;
  double fuzz;  // of metal
};

class Field {
 public:
  explicit Field(int spheres) : side_(static_cast<int>(std::ceil(std::sqrt(spheres / 4.0)))) {}

  FieldSphere next() {
    const int layer = next_ % 4, place = next_ / 4;
    ++next_;
    const double radius = 0.1 + 0.3 * uniform();
    const auto jitter = [&] { return (uniform() - 0.5) * (1 - 2 * radius); };
    FieldSphere sphere{.x = rounded(place % side_ - side_ / 2.0 + 0.5 + jitter()),
                       .y = rounded(layer + 0.5 + jitter()),
                       .z = rounded(-(place / side_) - 0.5 + jitter()),
                       .radius = rounded(radius),
                       .kind = Kind::Glass,
                       .red = 255,
                       .green = 255,
                       .blue = 255,
                       .fuzz = 0};
    const double choice = uniform();
    if (choice < 0.9) {
      sphere.kind = choice < 0.7 ? Kind::Matt : Kind::Metal;
      for (int* channel : {&sphere.red, &sphere.green, &sphere.blue}) {
        *channel = 25 + static_cast<int>(uniform() * 220);
      }
      sphere.fuzz = rounded(0.4 * uniform());
    }
    return sphere;
  }

 private:
  double uniform() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  static double rounded(double x) { return std::round(x * 1e5) / 1e5; }

  std::mt19937_64 engine_{7};
  int side_;
  int next_ = 0;
};

void append_json(const FieldSphere& s, std::string& text) {
  static constexpr std::string_view kTypes[] = {"diffuse", "specular", "transmissive"};
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 R"({{"origin":[{},{},{}],"radius":{},"material":{{"type":"{}","color":[{},{},{}])",
                 s.x, s.y, s.z, s.radius, kTypes[static_cast<int>(s.kind)], s.red, s.green, s.blue);
  if (s.kind == Kind::Metal) fmt::format_to(out, R"(,"fuzz":{})", s.fuzz);
  if (s.kind == Kind::Glass) text += R"(,"refraction_index":1.5)";
  text += "}}";
}

void append_scene(const FieldSphere& s, std::string& text) {
  static constexpr std::string_view kMaterials[] = {"diffuse", "specular", "transmissive"};
  const auto out = std::back_inserter(text);
  fmt::format_to(out,
                 "sphere {{ center: ({}, {}, {}), radius: {}, material: {}(color: linear255({}, "
                 "{}, {})",
                 s.x, s.y, s.z, s.radius, kMaterials[static_cast<int>(s.kind)], s.red, s.green,
                 s.blue);
  if (s.kind == Kind::Metal) fmt::format_to(out, ", fuzz: {}", s.fuzz);
  if (s.kind == Kind::Glass) text += ", ior: 1.5";
  text += ") }\n";
}

constexpr std::string_view kSceneHead =
    "scene 1\n"
    "camera main { from: (0, 14, 30), at: (0, 0, -225), fov: 50deg }\n";

}  // namespace

std::string field_as_json(int spheres) {
  std::string text;
  text.reserve(1000 + static_cast<std::size_t>(spheres) * kBytesPerSphere);
  text +=
      R"({"camera": {"look_from": [0, 14, 30], "look_at": [0, 0, -225], "up": [0, 1, 0], "vfov": 50, )"
      R"("focal_length": 1, "aspect_ratio": 1.7777777777777777, "viewport_height": 2, )"
      R"("samples_per_pixel": 16}, )"
      R"("rendering": {"width": 800, "render_depth": 32, "in_parallel": true}, )"
      R"("saving": {"path": "field.ppm", "gamma_correct": true}, "spheres": [)";
  Field field(spheres);
  for (int i = 0; i < spheres; ++i) {
    text += i == 0 ? "\n" : ",\n";
    append_json(field.next(), text);
  }
  text += "\n]}\n";
  return text;
}

std::string field_as_scene(int spheres) {
  std::string text;
  text.reserve(1000 + static_cast<std::size_t>(spheres) * kBytesPerSphere);
  text += kSceneHead;
  Field field(spheres);
  for (int i = 0; i < spheres; ++i) append_scene(field.next(), text);
  return text;
}

std::string loop_as_scene(int spheres) {
  return fmt::format(
      "{}let mat = diffuse(color: linear(0.5, 0.5, 0.5))\n"
      "for i in range({}) {{\n"
      "  sphere {{ center: (random(i, 1) * 100, i * 0.001, random(i, 2) * 100 - 50),\n"
      "           radius: 0.1 + 0.05 * random(i, 3), material: mat }}\n"
      "}}\n",
      kSceneHead, spheres);
}

std::string comprehension_as_scene(int spheres) {
  return fmt::format(
      "{0}let centers = [(random(i, 1) * 100, i * 0.001, random(i, 2) * 100 - 50)\n"
      "               for i in range({1})]\n"
      "let radii = [0.1 + 0.05 * random(i, 3) for i in range({1})]\n"
      "sphere {{ center: centers[{1} - 1], radius: radii[{1} - 1],\n"
      "         material: diffuse(color: linear(0.5, 0.5, 0.5)) }}\n",
      kSceneHead, spheres);
}

std::string data_as_scene() {
  return fmt::format(
      "{}import \"field.csv\" as rows\n"
      "let mat = diffuse(color: linear(0.5, 0.5, 0.5))\n"
      "for row in rows {{\n"
      "  sphere {{ center: (row.x, row.y, row.z), radius: row.radius, material: mat }}\n"
      "}}\n",
      kSceneHead);
}

std::string field_as_csv(int spheres) {
  std::string text = "x,y,z,radius\n";
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-50, 50), size(0.1, 0.15);
  for (int i = 0; i < spheres; ++i) {
    fmt::format_to(std::back_inserter(text), "{:.6g},{:.6g},{:.6g},{:.6g}\n", place(random),
                   i * 0.001, place(random), size(random));
  }
  return text;
}

}  // namespace sdlc::bench
