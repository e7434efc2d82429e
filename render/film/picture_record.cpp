#include "render/film/picture_record.hpp"

#include "render/film/text_record.hpp"

namespace sdlc::render {
namespace {

constexpr auto kCompared = [](auto& record, auto visit) {
  visit("frame", record.frame);
  visit("spheres", record.spheres);
  visit("instances", record.instances);
  visit("features", record.features);
  visit("samples", record.samples);
  visit("error", record.error);
  visit("adaptive", record.is_adaptive);
  visit("denoise", record.is_denoised);
  visit("light_sampling", record.light_sampling);
  visit("light_choice", record.light_choice);
  visit("may_have_casters", record.may_have_casters);
  visit("tone", record.tone);
  visit("exposure", record.exposure);
  visit("depth_exponent", record.depth_exponent);
  visit("shards", record.shards);
  visit("shard_by", record.cut);
};

constexpr auto kAll = [](auto& record, auto visit) {
  visit("scene", record.scene);
  kCompared(record, visit);
};

}  // namespace

std::string text_of(const PictureRecord& record) { return text::text_of(record, kAll); }

bool read_text(std::string_view text, PictureRecord& record) {
  return text::read_text(text, record, kAll);
}

std::string difference(const PictureRecord& record, const PictureRecord& expected) {
  return text::difference(record, expected, kCompared);
}

}  // namespace sdlc::render
