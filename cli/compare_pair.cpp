#include "cli/compare_pair.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "cli/outputs.hpp"
#include "cli/usage_error.hpp"
#include "lang/text/display_width.hpp"
#include "render/compare/difference.hpp"
#include "render/image/io_error.hpp"
#include "render/image/picture.hpp"
#include "render/math/color.hpp"

namespace sdlc::cli {
namespace {

using render::IoError;
using render::LinearRgb;
using render::PictureFile;

/// Throws at the first value that is not wanted, with its position.
template <typename IsWanted>
void check_values(const std::string& name, const render::Picture& picture, std::string_view what,
                  std::string_view fault, IsWanted is_wanted) {
  std::size_t count = 0;
  std::string first;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    const LinearRgb c = picture.pixels[i];
    const std::array values{c.r, c.g, c.b};
    for (std::size_t channel = 0; channel < 3; ++channel) {
      if (is_wanted(values[channel]) || count++ > 0) continue;
      const auto width = static_cast<std::size_t>(picture.width);
      first = fmt::format("{} in {} of the pixel ({}, {})", values[channel],
                          render::kChannelNames[channel], i % width, i / width);
    }
  }
  if (count == 0) return;
  throw IoError("compare", name,
                fmt::format("{} of its {} {} {}; the first is {}", count, what,
                            count == 1 ? "is" : "are", fault, first));
}

PictureFile read(const std::string& name) {
  if (name == kStandardStream) {
    throw UsageError(
        "pictures cannot be read from standard input: the format follows from the name");
  }
  picture_format(name, "read");
  PictureFile file = render::read_picture_file(name);
  check_values(name, file.picture, "values", "not finite",
               [](double v) { return std::isfinite(v); });
  if (file.variance) {
    check_values(name, *file.variance, "variances", "negative or not finite",
                 [](double v) { return std::isfinite(v) && v >= 0; });
  }
  return file;
}

/// nullopt if the file does not record it.
std::optional<render::ToneMapping> mapping_in(const PictureFile& file) {
  const auto word = file.find_metadata("sdlc:tone");
  const auto tone = word ? render::tone_of(*word) : std::nullopt;
  if (!tone) return std::nullopt;
  render::ToneMapping mapping{.tone = *tone};
  if (const auto stops = file.find_metadata("sdlc:exposure")) {
    std::from_chars(stops->data(), stops->data() + stops->size(), mapping.exposure);
  }
  return mapping;
}

/// The flags whose values differ.
std::string differing_flags(const render::ToneMapping& a, const render::ToneMapping& b) {
  if (a.exposure == b.exposure) return "--tone";
  return a.tone == b.tone ? "--exposure" : "--tone and --exposure";
}

bool is_exr(const PictureFile& file) { return file.format == render::ImageFormat::Exr; }

std::string describe_crop(const PictureFile& file) {
  const render::PixelWindow& crop = file.crop;
  return fmt::format("{} x {} pixels at ({}, {}) of a picture of {} x {}", crop.width, crop.height,
                     crop.x, crop.y, file.whole_width, file.whole_height);
}

void check_match(const ComparedPair& pair) {
  const PictureFile &a = pair.picture, &b = pair.reference;
  const std::string a_name = lang::printable(pair.picture_name);
  const std::string b_name = lang::printable(pair.reference_name);
  if (a.picture.width != b.picture.width || a.picture.height != b.picture.height) {
    throw UsageError(fmt::format(
        "`{}` has {} x {} pixels and `{}` {} x {}; only pictures of the same size can be compared",
        a_name, a.picture.width, a.picture.height, b_name, b.picture.width, b.picture.height));
  }
  const bool is_same_crop =
      a.crop == b.crop && a.whole_width == b.whole_width && a.whole_height == b.whole_height;
  if (is_exr(a) && is_exr(b) && !is_same_crop) {
    throw UsageError(fmt::format("`{}` has {} and `{}` {}; only the same pixels can be compared",
                                 a_name, describe_crop(a), b_name, describe_crop(b)));
  }
  if (a.is_linear != b.is_linear) {
    throw UsageError(
        fmt::format("`{}` holds linear radiance and `{}` the codes of a tone curve; compare two "
                    "files of the same kind, such as two .exr or two .png",
                    a.is_linear ? a_name : b_name, a.is_linear ? b_name : a_name));
  }
  if (a.is_grey != b.is_grey) {
    throw UsageError(fmt::format("`{}` is grey and `{}` has colours; make both the same",
                                 a.is_grey ? a_name : b_name, a.is_grey ? b_name : a_name));
  }
  const auto a_mapping = mapping_in(a), b_mapping = mapping_in(b);
  if (a_mapping && b_mapping && a_mapping != b_mapping) {
    throw UsageError(fmt::format(
        "`{}` has codes of the tone {} and `{}` of {}; render one of them with the other's {}, "
        "or compare .exr files",
        a_name, describe(*a_mapping), b_name, describe(*b_mapping),
        differing_flags(*a_mapping, *b_mapping)));
  }
}

void choose_tone(ComparedPair& pair) {
  if (pair.picture.is_linear) {
    pair.tone = render::Tone::Linear;
    return;
  }
  const auto a = mapping_in(pair.picture), b = mapping_in(pair.reference);
  const render::ToneMapping usual, mapping = a ? *a : b.value_or(usual);
  pair.tone = mapping.tone;
  // Do not mention sRGB, the usual case.
  if (mapping == usual || (a && b)) return;
  pair.notes.push_back(fmt::format("{} does not record its tone; assuming that of the other, {}",
                                   lang::printable(a ? pair.reference_name : pair.picture_name),
                                   describe(mapping)));
}

void note_others(const std::string& name, const PictureFile& file,
                 std::vector<std::string>& notes) {
  if (file.other_channels.empty()) return;
  notes.push_back(
      fmt::format("not compared: {} of {}",
                  lang::printable(fmt::format("{}", fmt::join(file.other_channels, ", "))),
                  lang::printable(name)));
}

/// Pictures with the same seed share the noise of the paths that they have in common.
void note_shared_noise(ComparedPair& pair) {
  const auto seed = pair.picture.find_metadata("sdlc:seed");
  const auto sampler = pair.picture.find_metadata("sdlc:sampler");
  if (!seed || seed != pair.reference.find_metadata("sdlc:seed") ||
      sampler != pair.reference.find_metadata("sdlc:sampler")) {
    return;
  }
  pair.notes.push_back(
      fmt::format("both have seed {}: they share noise, so the z-test is less sensitive; render "
                  "one of them with another --seed",
                  lang::printable(*seed)));
}

}  // namespace

std::string ComparedPair::values() const {
  if (picture.is_linear) return "linear radiance";
  const int codes = picture.largest_code, reference_codes = reference.largest_code;
  if (codes == reference_codes) return fmt::format("codes / {}", codes);
  return fmt::format("codes / {} and codes / {}", codes, reference_codes);
}

ComparedPair read_pair(const std::string& picture, const std::string& reference) {
  ComparedPair pair{.picture_name = picture,
                    .reference_name = reference,
                    .picture = read(picture),
                    .reference = read(reference),
                    .notes = {}};
  check_match(pair);
  choose_tone(pair);
  note_others(picture, pair.picture, pair.notes);
  note_others(reference, pair.reference, pair.notes);
  pair.has_variance = pair.picture.variance && pair.reference.variance;
  if (pair.has_variance) {
    note_shared_noise(pair);
  } else if (pair.picture.variance || pair.reference.variance) {
    pair.notes.push_back(fmt::format("no z-test: {} has no variance",
                                     lang::printable(pair.picture.variance ? reference : picture)));
  }
  return pair;
}

}  // namespace sdlc::cli
