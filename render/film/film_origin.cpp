#include "render/film/film_origin.hpp"

#include "render/film/text_record.hpp"

namespace sdlc::render {
namespace {

constexpr auto kMembers = [](auto& origin, auto visit) {
  visit("spheres", origin.scene.spheres);
  visit("materials", origin.scene.materials);
  visit("camera", origin.scene.camera);
  visit("background", origin.scene.background);
  visit("width", origin.width);
  visit("height", origin.height);
  visit("crop_x", origin.crop.x);
  visit("crop_y", origin.crop.y);
  visit("crop_width", origin.crop.width);
  visit("crop_height", origin.crop.height);
  visit("depth", origin.depth);
  visit("seed", origin.seed);
  visit("sampler", origin.sampler);
  visit("centred", origin.is_centred);
  visit("replicates", origin.replicates);
  visit("first_hits", origin.has_first_hits);
  visit("precision", origin.precision);
  visit("lights_at_metal", origin.samples_at_metal);
  visit("arithmetic", origin.arithmetic);
  visit("program", origin.program);
};

}  // namespace

std::string text_of(const FilmOrigin& origin) { return text::text_of(origin, kMembers); }

bool read_text(std::string_view text, FilmOrigin& origin) {
  return text::read_text(text, origin, kMembers);
}

std::string difference(const FilmOrigin& origin, const FilmOrigin& expected) {
  return text::difference(origin, expected, kMembers);
}

}  // namespace sdlc::render
