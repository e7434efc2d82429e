#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "render/image/tone.hpp"
#include "render/scene/scene.hpp"
#include "render/scene/settings.hpp"

namespace sdlc::render {

/// How the samples of a picture are divided among shards.
enum class ShardCut : std::uint8_t {
  Samples,  ///< of every pixel, between blocks of SampleSum::kBlock
  Tiles,    ///< runs of pixels
};
template <>
inline constexpr auto kWords<ShardCut> = std::to_array<std::string_view>({"samples", "tiles"});
template <>
inline constexpr auto kWords<Tone> = kToneWords;

/// The largest number of shards of a picture.
inline constexpr std::uint32_t kMaxShards = 1'000'000;

/// What a picture and its statistics have beside the samples of its film: who merges films has no
/// scene.
struct PictureRecord {
  std::string scene;         ///< the name of its file; only to be shown
  std::optional<int> frame;  ///< of an animation
  std::uint64_t spheres = 0, instances = 0;
  std::string features;  ///< what the scene requires, with spaces between
  int samples = 0;       ///< RenderSettings::samples
  double error = 0;      ///< RenderSettings::error; 0: none
  bool is_adaptive = false;
  bool is_denoised = false;
  LightSampling light_sampling{};
  std::string light_choice;  ///< Kernel::light_choice
  bool may_have_casters = false;
  Tone tone{};
  double exposure = 0;
  int depth_exponent = 0;  ///< Tracer::depth_exponent()
  std::uint32_t shards = 1;
  ShardCut cut{};

  friend bool operator==(const PictureRecord&, const PictureRecord&) = default;
};

/// The members as lines of name and value.
std::string text_of(const PictureRecord& record);
/// Reads text_of(). Returns false if it is not such a text.
bool read_text(std::string_view text, PictureRecord& record);

/// The first member that differs, except `scene`; empty if none does.
std::string difference(const PictureRecord& record, const PictureRecord& expected);

}  // namespace sdlc::render
