#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "render/film/film_file.hpp"
#include "render/film/film_sections.hpp"
#include "render/film/merge_films.hpp"
#include "render/image/io_error.hpp"
#include "render/image/picture.hpp"

namespace sdlc::render {
namespace {

namespace fs = std::filesystem;
using Reason = FilmError::Reason;

class Reader {
 public:
  explicit Reader(const fs::path& path) : path_(path), file_(path, std::ios::binary) {
    std::error_code error;
    left_ = fs::file_size(path, error);
    if (error) throw IoError("read", path, error.message());
    if (!file_) throw IoError("read", path, std::generic_category().message(errno));
  }

  FilmHead read_beginning() {
    read_head();
    for (Tag tag{}; tag != kShards;) {
      tag = begin_section();
      if (tag == kEnd) damaged("a section is missing");
      read_section(tag);
      end_section();
    }
    return {.record = std::move(film_.record), .shards = std::move(film_.shards)};
  }

  StoredFilm run() {
    read_head();
    std::vector<Tag> known;  // the sections so far
    while (known.empty() || known.back() != kEnd) {
      const Tag tag = begin_section();
      if (is_single(tag) && std::ranges::count(known, tag) > 0) {
        damaged("a section is there twice");
      }
      known.push_back(tag);
      read_section(tag);
      end_section();
    }
    if (left_ > 0) damaged("bytes follow the end");
    for (const Tag tag : {kOrigin, kRecord, kStatistics, kClasses}) {
      if (std::ranges::count(known, tag) == 0) damaged("a section is missing");
    }
    check_films();
    return std::move(film_);
  }

 private:
  static bool is_single(Tag tag) {
    constexpr std::array kSingle{kOrigin, kRecord,  kShards,   kStatistics, kLights, kCasters,
                                 kExact,  kClasses, kEmitters, kTargets,    kPasses};
    return std::ranges::count(kSingle, tag) > 0;
  }

  [[noreturn]] void damaged(const std::string& cause) const {
    throw FilmError(Reason::Damaged, path_, "the file is damaged: " + cause);
  }

  void read_head() {
    std::array<char, kMark.size()> mark{};
    const bool is_film =
        left_ >= mark.size() && (take(std::as_writable_bytes(std::span(mark))),
                                 std::string_view(mark.data(), mark.size()) == kMark);
    if (!is_film) throw FilmError(Reason::NotAFilm, path_, "the file is not a film");
    if (const auto version = take<std::uint32_t>(); version != kVersion) {
      throw FilmError(Reason::OtherVersion, path_,
                      "the film has version " + std::to_string(version) +
                          " of the format; this program reads version " + std::to_string(kVersion));
    }
  }

  Tag begin_section() {
    hash_ = {};
    section_ = sizeof(Tag) + sizeof(std::uint64_t);
    const Tag tag = take<Tag>();
    const auto size = take<std::uint64_t>();
    if (left_ < sizeof(std::uint64_t) || size > left_ - sizeof(std::uint64_t)) {
      damaged("it ends too early");
    }
    section_ = size;
    return tag;
  }

  void end_section() {
    if (section_ != 0) damaged("a section is too long");
    const std::uint64_t expected = hash_.value();
    section_ = sizeof(std::uint64_t);
    if (take<std::uint64_t>() != expected) damaged("a checksum is wrong");
  }

  void read_section(Tag tag) {
    if (tag == kOrigin) return read_record(film_.origin);
    if (tag == kRecord) return read_record(film_.record);
    if (tag == kClasses) return read_classes();
    if (tag == kShards) {
      film_.shards = take_rest<std::uint32_t>();
    } else if (tag == kPasses) {
      film_.passes = take_rest<GoalPass>();
    } else if (tag == kStatistics) {
      film_.statistics = take<TraceCounts>();
    } else if (tag == kLights) {
      film_.lights = take_rest<std::uint32_t>();
    } else if (tag == kCasters) {
      film_.casters = take_rest<std::uint32_t>();
    } else if (tag == kExact) {
      film_.exact_spheres = take_rest<std::uint32_t>();
    } else if (tag == kEmitters) {
      film_.emitters = take_rest<EmitterCount>();
    } else if (tag == kTargets) {
      film_.targets = take_rest<std::uint32_t>();
    } else if (tag == kFilm) {
      read_film();
    } else {
      take_rest<std::byte>();  // of a later version, and not needed to use the film
    }
  }

  /// Whether the films are of the picture of the origin.
  void check_films() {
    const FilmOrigin& origin = film_.origin;
    const PixelWindow& crop = origin.crop;
    const std::uint64_t pixels = crop.width > 0 && crop.height > 0 ? crop.pixels() : 0;
    constexpr std::uint32_t kMax = std::numeric_limits<std::int32_t>::max();
    bool is_sound = pixels > 0 && origin.width <= kMax && origin.height <= kMax && crop.x >= 0 &&
                    crop.y >= 0 && std::int64_t{crop.x} + crop.width <= origin.width &&
                    std::int64_t{crop.y} + crop.height <= origin.height && origin.depth > 0 &&
                    origin.depth <= kMax &&
                    (origin.replicates == 1 || origin.replicates == kReplicates) &&
                    (film_.targets.empty() || film_.targets.size() == pixels);
    is_sound = is_sound && pixels <= static_cast<std::uint64_t>(kMaxPicturePixels) &&
               has_sound_record() && has_sound_passes();
    const std::uint32_t shards = film_.record.shards;
    is_sound =
        is_sound && shards >= 1 && shards <= kMaxShards &&
        std::ranges::is_sorted(film_.shards, std::ranges::less_equal()) &&
        std::ranges::all_of(film_.shards, [&](std::uint32_t i) { return i >= 1 && i <= shards; }) &&
        has_sound_emitters();
    for (const EmitterCount& count : film_.emitters) {
      is_sound = is_sound && count.paths <= count.enough;
    }
    for (const Film& film : film_.films) {
      const FilmExtent& extent = film.extent();
      is_sound = is_sound && extent.replicates == origin.replicates &&
                 extent.first_pixel <= pixels && extent.pixels <= pixels - extent.first_pixel &&
                 (film.channels() != Channels::Color) == origin.has_first_hits;
    }
    if (!is_sound) damaged("its films are of another picture");
    std::vector<const Film*> films;
    for (const Film& film : film_.films) films.push_back(&film);
    try {
      check_no_sample_is_doubled(std::move(films));
    } catch (const DoubledSample& doubled) {
      damaged(doubled.what());
    }
  }

  template <typename Record>
  void read_record(Record& record) {
    const std::vector<char> text = take_rest<char>();
    if (!read_text(std::string_view(text.data(), text.size()), record)) {
      damaged("its description cannot be read");
    }
  }

  void read_classes() {
    const auto stored = take<StoredClasses>();
    EmitterClasses& emitters = film_.emitter_classes;
    emitters.brightest = stored.brightest;
    emitters.has_casters = stored.has_casters != 0;
    if (stored.classes > section_ / sizeof(StoredClass)) damaged("a film cannot be read");
    for (std::uint32_t i = 0; i < stored.classes; ++i) {
      const auto each = take<StoredClass>();
      emitters.classes.push_back(
          {.sphere = each.sphere, .radiance = each.radiance, .kinds = each.kinds});
    }
    emitters.emitters = take_rest<std::uint32_t>();
    spheres_ = stored.spheres;
  }

  bool has_sound_record() const {
    const PictureRecord& record = film_.record;
    return record.samples > 0 && std::isfinite(record.error) && record.error >= 0 &&
           std::isfinite(record.exposure);
  }

  bool has_sound_passes() const {
    std::uint64_t before = 0;
    return std::ranges::all_of(film_.passes, [&](const GoalPass& pass) {
      return pass.samples > std::exchange(before, pass.samples) && pass.samples <= INT32_MAX;
    });
  }

  /// Whether the counts of emitters are those of its classes; gives them the number of spheres.
  bool has_sound_emitters() {
    EmitterClasses& emitters = film_.emitter_classes;
    // A count for each sphere, so that there are not more than bytes.
    const bool is_small = emitters.emitters.empty() || spheres_ <= film_.emitters.size();
    const bool are_spheres = std::ranges::all_of(
        emitters.emitters, [&](std::uint32_t sphere) { return sphere < spheres_; });
    const bool has_class = !emitters.has_casters || !emitters.classes.empty();
    if (!is_small || !are_spheres || !has_class) return false;
    emitters.of_spheres.assign(emitters.emitters.empty() ? 0 : spheres_, EmitterClasses::kNone);
    const auto depth = static_cast<int>(film_.origin.depth);
    return std::ranges::equal(EmitterTally(emitters, depth).counts(), film_.emitters, {},
                              &EmitterCount::enough, &EmitterCount::enough);
  }

  void read_film() {
    const auto stored = take<StoredExtent>();
    const bool is_sound =
        (stored.replicates == 1 || stored.replicates == kReplicates) &&
        stored.first_sample % SampleSum::kBlock == 0 && stored.has_first_hits <= 1 &&
        stored.pixels <= section_ / (stored.replicates * sizeof(std::uint32_t) +
                                     stored.has_first_hits * sizeof(FirstHitSums));
    if (!is_sound) damaged("a film cannot be read");
    Film film({.first_pixel = stored.first_pixel,
               .pixels = static_cast<std::size_t>(stored.pixels),
               .first_sample = stored.first_sample,
               .replicates = stored.replicates},
              stored.has_first_hits == 1 ? Channels::ColorAndFirstHits : Channels::Color);
    std::vector<ReplicateCounts> counts(film.size());
    for_each_sum(film, [&](std::size_t pixel, std::uint32_t r) {
      counts[pixel][r] = take<std::uint32_t>();
    });
    std::uint64_t size = stored.has_first_hits * film.size() * sizeof(FirstHitSums);
    for_each_sum(film, [&](std::size_t pixel, std::uint32_t r) {
      const std::uint64_t end = std::uint64_t{stored.first_sample} + counts[pixel][r];
      if (end > std::numeric_limits<std::uint32_t>::max()) damaged("a film cannot be read");
      size += SampleSum::values_of(stored.first_sample, static_cast<std::uint32_t>(end)) *
              sizeof(LinearRgb);
    });
    if (size != section_) damaged("a film cannot be read");
    film.reserve(counts);
    std::vector<LinearRgb> values;
    for_each_sum(film, [&](std::size_t pixel, std::uint32_t r) {
      const std::uint32_t end = stored.first_sample + counts[pixel][r];
      values.resize(SampleSum::values_of(stored.first_sample, end));
      take(std::as_writable_bytes(std::span(values)));
      film.set(pixel, r, SampleSum(values, stored.first_sample, end));
    });
    for (std::size_t pixel = 0; stored.has_first_hits == 1 && pixel < film.size(); ++pixel) {
      film.first_hits(pixel) = take<FirstHitSums>();
    }
    film_.films.push_back(std::move(film));
  }

  /// Reads the next bytes of the section.
  void take(std::span<std::byte> bytes) {
    if (bytes.size() > std::min(left_, section_)) damaged("it ends too early");
    if (!file_.read(reinterpret_cast<char*>(bytes.data()),
                    static_cast<std::streamsize>(bytes.size()))) {
      throw IoError("read", path_, std::generic_category().message(errno));
    }
    add_to(hash_, bytes);
    left_ -= bytes.size();
    section_ -= bytes.size();
  }
  template <Plain T>
  T take() {
    T value{};
    take(std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }
  template <Plain T>
  std::vector<T> take_rest() {
    std::vector<T> values(section_ / sizeof(T));
    take(std::as_writable_bytes(std::span(values)));
    return values;
  }

  const fs::path& path_;
  std::ifstream file_;
  std::uint64_t left_ = 0;                                   // bytes of the file
  std::uint64_t section_ = kMark.size() + sizeof(kVersion);  // bytes of the section
  Fnv1a hash_;                                               // of the section
  std::uint64_t spheres_ = 0;                                // of the scene
  StoredFilm film_;
};

}  // namespace

StoredFilm read_film_file(const fs::path& path) { return Reader(path).run(); }

FilmHead read_film_head(const fs::path& path) { return Reader(path).read_beginning(); }

}  // namespace sdlc::render
