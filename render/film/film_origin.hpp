#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "render/scene/digest.hpp"
#include "render/scene/scene.hpp"

namespace sdlc::render {

/// What the samples of a film depend on. Films can be joined if their origins are equal.
struct FilmOrigin {
  SceneDigest scene;
  std::uint32_t width = 0, height = 0;
  PixelWindow crop;  ///< RenderSettings::window(); the pixels of the films are those of it
  std::uint32_t depth = 0;
  std::uint64_t seed = 0;
  SamplerKind sampler = SamplerKind::Sobol;
  bool is_centred = false;       ///< RenderSettings::is_centred()
  std::uint32_t replicates = 0;  ///< FilmExtent::replicates of all films
  bool has_first_hits = false;   ///< RenderSettings::keeps_first_hits
  Precision precision = Precision::Double;
  bool samples_at_metal = false;  ///< Kernel::samples_at_metal
  /// "fused" or "separate": how products are rounded before they are added (Backend::is_fused).
  std::string arithmetic;
  /// The version of the program.
  std::string program;

  friend bool operator==(const FilmOrigin&, const FilmOrigin&) = default;
};

/// The members as lines of name and value.
std::string text_of(const FilmOrigin& origin);
/// Reads text_of(). Returns false if it is not such a text.
bool read_text(std::string_view text, FilmOrigin& origin);

/// The first member that differs, such as "`depth` is 8, not 16" or "it differs in `camera`";
/// empty if none does.
std::string difference(const FilmOrigin& origin, const FilmOrigin& expected);

}  // namespace sdlc::render
