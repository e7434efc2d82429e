#include "render/image/enlarge.hpp"

#include <cstddef>

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

}  // namespace sdlc::render
