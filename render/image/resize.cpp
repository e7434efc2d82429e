#include "render/image/resize.hpp"

#include <cstddef>
#include <cstdint>

namespace sdlc::render {
namespace {

template <typename T>
std::vector<T> enlarged(const std::vector<T>& values, std::size_t width, std::size_t factor) {
  std::vector<T> large;
  large.reserve(values.size() * factor * factor);
  for (std::size_t row = 0; row < values.size(); row += width) {
    for (std::size_t copy = 0; copy < factor; ++copy) {
      for (std::size_t x = 0; x < width; ++x) large.insert(large.end(), factor, values[row + x]);
    }
  }
  return large;
}

}  // namespace

Picture enlarged(const Picture& picture, int factor) {
  Picture large;
  large.width = picture.width * factor;
  large.height = picture.height * factor;
  large.pixels = enlarged(picture.pixels, static_cast<std::size_t>(picture.width),
                          static_cast<std::size_t>(factor));
  return large;
}

Layer enlarged(const Layer& layer, int width, int factor) {
  return {.name = layer.name,
          .values = enlarged(layer.values, static_cast<std::size_t>(width),
                             static_cast<std::size_t>(factor))};
}

Picture shrunk(const Picture& picture, int width, int height) {
  const auto edge = [](int i, int fewer, int count) {
    return static_cast<int>(std::int64_t{i} * count / fewer);
  };
  Picture smaller(width, height);
  for (int v = 0; v < height; ++v) {
    const int top = edge(v, height, picture.height), bottom = edge(v + 1, height, picture.height);
    for (int u = 0; u < width; ++u) {
      const int left = edge(u, width, picture.width), right = edge(u + 1, width, picture.width);
      LinearRgb sum;
      for (int y = top; y < bottom; ++y) {
        for (int x = left; x < right; ++x) sum = sum + picture.at(x, y);
      }
      smaller.at(u, v) = sum / static_cast<double>((bottom - top) * (right - left));
    }
  }
  return smaller;
}

}  // namespace sdlc::render
