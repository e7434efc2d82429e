#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "render/film/film_file.hpp"
#include "render/film/film_sections.hpp"
#include "render/image/atomic_file.hpp"

namespace sdlc::render {
namespace {

/// Writes one section. The content is passed in pieces, and has the announced size.
class SectionWriter {
 public:
  SectionWriter(const WritePiece& write, Tag tag, std::uint64_t size) : write_(write) {
    buffer_.reserve(kBuffer);
    add(bytes_of(tag));
    add(bytes_of(size));
  }
  ~SectionWriter() = default;
  SectionWriter(const SectionWriter&) = delete;
  SectionWriter& operator=(const SectionWriter&) = delete;

  void add(std::span<const std::byte> bytes) {
    add_to(hash_, bytes);
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    if (buffer_.size() >= kBuffer) flush();
  }
  void end() {
    const std::uint64_t checksum = hash_.value();
    add(bytes_of(checksum));
    flush();
  }

 private:
  static constexpr std::size_t kBuffer = std::size_t{1} << 18;

  void flush() {
    write_(buffer_);
    buffer_.clear();
  }

  const WritePiece& write_;
  Fnv1a hash_;
  std::vector<std::byte> buffer_;
};

void write_section(const WritePiece& write, Tag tag, std::span<const std::byte> content) {
  SectionWriter section(write, tag, content.size());
  section.add(content);
  section.end();
}

void write_film(const WritePiece& write, const Film& film) {
  const FilmExtent& extent = film.extent();
  const bool has_first_hits = film.channels() != Channels::Color;
  const StoredExtent stored{extent.first_pixel, extent.pixels, extent.first_sample,
                            extent.replicates, has_first_hits ? 1u : 0u};
  std::uint64_t size = sizeof(stored) + (has_first_hits ? film.size() * sizeof(FirstHitSums) : 0);
  for_each_sum(film, [&](std::size_t pixel, std::uint32_t r) {
    size += sizeof(std::uint32_t) + film.sum(pixel, r).values().size_bytes();
  });
  SectionWriter section(write, kFilm, size);
  section.add(bytes_of(stored));
  for_each_sum(film, [&](std::size_t pixel, std::uint32_t r) {
    const std::uint32_t count = film.count(pixel, r);
    section.add(bytes_of(count));
  });
  for_each_sum(film, [&](std::size_t pixel, std::uint32_t r) {
    section.add(std::as_bytes(film.sum(pixel, r).values()));
  });
  for (std::size_t pixel = 0; has_first_hits && pixel < film.size(); ++pixel) {
    section.add(bytes_of(film.first_hits(pixel)));
  }
  section.end();
}

void write_classes(const WritePiece& write, const EmitterClasses& emitters) {
  const StoredClasses stored{.brightest = emitters.brightest,
                             .has_casters = emitters.has_casters ? 1u : 0u,
                             .classes = static_cast<std::uint32_t>(emitters.classes.size()),
                             .spheres = emitters.of_spheres.size()};
  const auto ids = std::as_bytes(std::span(emitters.emitters));
  SectionWriter section(write, kClasses,
                        sizeof(stored) + stored.classes * sizeof(StoredClass) + ids.size());
  section.add(bytes_of(stored));
  for (const EmitterClasses::Class& each : emitters.classes) {
    section.add(bytes_of(
        StoredClass{.radiance = each.radiance, .sphere = each.sphere, .kinds = each.kinds}));
  }
  section.add(ids);
  section.end();
}

}  // namespace

void write_film_file(const std::filesystem::path& path, const StoredFilm& film) {
  const std::string origin = text_of(film.origin), record = text_of(film.record);
  write_file_atomically(path, [&](const WritePiece& write) {
    write(std::as_bytes(std::span(kMark)));
    write(bytes_of(kVersion));
    write_section(write, kOrigin, std::as_bytes(std::span(origin)));
    write_section(write, kRecord, std::as_bytes(std::span(record)));
    write_section(write, kShards, std::as_bytes(std::span(film.shards)));
    write_section(write, kStatistics, bytes_of(film.statistics));
    write_section(write, kLights, std::as_bytes(std::span(film.lights)));
    write_section(write, kCasters, std::as_bytes(std::span(film.casters)));
    write_section(write, kExact, std::as_bytes(std::span(film.exact_spheres)));
    write_classes(write, film.emitter_classes);
    write_section(write, kEmitters, std::as_bytes(std::span(film.emitters)));
    write_section(write, kTargets, std::as_bytes(std::span(film.targets)));
    write_section(write, kPasses, std::as_bytes(std::span(film.passes)));
    for (const Film& each : film.films) write_film(write, each);
    write_section(write, kEnd, {});
  });
}

}  // namespace sdlc::render
