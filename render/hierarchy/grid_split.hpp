#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/hierarchy/bins.hpp"
#include "render/hierarchy/build_primitives.hpp"
#include "render/parallel/parallel_for.hpp"

namespace sdlc::render {

/// Divides a very large number of primitives among the children of a node, on all threads. The
/// primitives are counted in the cells of a grid, the cells are divided instead of the primitives,
/// and each primitive is then written to its range. This reads each primitive three times in total,
/// instead of three times for each of the four levels of binary splits in a node.
///
/// `source(i)` returns primitive i of `count`. Work is split into ranges independent of the
/// threads, and results are combined in their order.
template <typename T, typename Source>
class GridSplit {
 public:
  GridSplit(const Source& source, std::size_t count)
      : source_(source),
        count_(count),
        chunks_(std::clamp<std::size_t>(count / kPrimitivesPerChunk, 1, kMaxChunks)) {}

  /// Writes the primitives to `to`, starting at `begin`. Returns a single range if all centroids
  /// coincide.
  NodeRanges<T> split(std::span<Primitive<T>> to, std::size_t begin) {
    const BinScale<T> scale(centroids());
    count_cells(scale);
    divide_cells();
    NodeRanges<T> ranges;
    for (const Region& region : regions_) {
      Range<T>& range = ranges.of[ranges.count++];
      range = {.begin = begin, .end = begin + region.count, .box = region.box};
      begin = range.end;
    }
    write(scale, ranges, to);
    return ranges;
  }

 private:
  static constexpr std::size_t kCells = kBins * kBins * kBins;
  static constexpr std::size_t kPrimitivesPerChunk = 16384, kMaxChunks = 64;
  static constexpr std::size_t kFewest = 64;  // smaller regions are not divided: the cells are too
                                              // coarse for them

  struct Cells {
    std::vector<BuildBox<T>> boxes = std::vector<BuildBox<T>>(kCells);
    std::vector<std::uint32_t> counts = std::vector<std::uint32_t>(kCells);
  };

  /// The cells [low, high) along each axis, and their contents.
  struct Region {
    std::array<std::size_t, 3> low{0, 0, 0}, high{kBins, kBins, kBins};
    BuildBox<T> box;
    std::size_t count = 0;
    bool is_divisible = true;
  };

  static std::size_t cell_of(const std::array<std::size_t, 3>& bin) noexcept {
    return (bin[0] * kBins + bin[1]) * kBins + bin[2];
  }

  template <typename Body>
  static void for_cells(const Region& region, const Body& body) {
    std::array<std::size_t, 3> bin;
    for (bin[0] = region.low[0]; bin[0] < region.high[0]; ++bin[0]) {
      for (bin[1] = region.low[1]; bin[1] < region.high[1]; ++bin[1]) {
        for (bin[2] = region.low[2]; bin[2] < region.high[2]; ++bin[2]) body(bin, cell_of(bin));
      }
    }
  }

  /// Calls body(range, primitive) for each primitive, with the ranges in parallel.
  template <typename Body>
  void for_primitives(const Body& body) const {
    parallel_for(chunks_, [&](std::size_t chunk) {
      const std::size_t end = count_ * (chunk + 1) / chunks_;
      for (std::size_t i = count_ * chunk / chunks_; i < end; ++i) body(chunk, source_(i));
    });
  }

  BuildBox<T> centroids() const {
    std::vector<BuildBox<T>> of_chunks(chunks_);
    for_primitives([&](std::size_t chunk, const Primitive<T>& primitive) {
      of_chunks[chunk].add(primitive.centroids());
    });
    BuildBox<T> all;
    for (const BuildBox<T>& box : of_chunks) all.add(box);
    return all;
  }

  void count_cells(const BinScale<T>& scale) {
    of_chunks_.resize(chunks_);
    for_primitives([&](std::size_t chunk, const Primitive<T>& primitive) {
      const std::size_t cell = cell_of(scale.bins_of(primitive));
      of_chunks_[chunk].boxes[cell].add(primitive.box());
      ++of_chunks_[chunk].counts[cell];
    });
    all_ = of_chunks_[0];
    for (std::size_t chunk = 1; chunk < chunks_; ++chunk) {
      for (std::size_t cell = 0; cell < kCells; ++cell) {
        all_.boxes[cell].add(of_chunks_[chunk].boxes[cell]);
        all_.counts[cell] += of_chunks_[chunk].counts[cell];
      }
    }
  }

  void divide_cells() {
    Region whole{.box = {}, .count = count_};
    for (const BuildBox<T>& box : all_.boxes) whole.box.add(box);
    regions_ = {whole};
    const auto area = [](const Region& r) { return r.is_divisible ? r.box.half_area() : T{-1}; };
    while (regions_.size() < kBvhWidth) {
      // The largest box first, as in the other builders.
      const auto largest = std::ranges::max_element(regions_, {}, area);
      if (!largest->is_divisible) return;
      const Cut<T> cut = best_cut(bins_of(*largest));
      largest->is_divisible = cut.exists();
      if (!cut.exists()) continue;
      Region below = *largest, above = *largest;
      below.high[cut.axis] = above.low[cut.axis] = cut.bin;
      gather(below);
      gather(above);
      *largest = below;
      regions_.push_back(above);
    }
  }

  Bins<T> bins_of(const Region& region) const {
    Bins<T> bins;
    for_cells(region, [&](const std::array<std::size_t, 3>& bin, std::size_t cell) {
      if (all_.counts[cell] > 0) bins.add(all_.boxes[cell], all_.counts[cell], bin);
    });
    return bins;
  }

  void gather(Region& region) const {
    region.box = {};
    region.count = 0;
    for_cells(region, [&](const std::array<std::size_t, 3>& /*bin*/, std::size_t cell) {
      region.box.add(all_.boxes[cell]);
      region.count += all_.counts[cell];
    });
    region.is_divisible = region.count > kFewest;
  }

  void write(const BinScale<T>& scale, const NodeRanges<T>& ranges,
             std::span<Primitive<T>> to) const {
    std::vector<std::uint8_t> range_of_cell(kCells);
    // The next position to write, per thread range and child range.
    std::vector<std::array<std::size_t, kBvhWidth>> next(chunks_);
    for (std::size_t range = 0; range < ranges.count; ++range) {
      std::vector<std::size_t> in_chunk(chunks_);
      for_cells(regions_[range], [&](const std::array<std::size_t, 3>& /*bin*/, std::size_t cell) {
        range_of_cell[cell] = static_cast<std::uint8_t>(range);
        for (std::size_t i = 0; i < chunks_; ++i) in_chunk[i] += of_chunks_[i].counts[cell];
      });
      std::size_t place = ranges.of[range].begin;
      for (std::size_t i = 0; i < chunks_; ++i) {
        next[i][range] = place;
        place += in_chunk[i];
      }
    }
    for_primitives([&](std::size_t chunk, const Primitive<T>& primitive) {
      const std::size_t cell = cell_of(scale.bins_of(primitive));
      to[next[chunk][range_of_cell[cell]]++] = primitive;
    });
  }

  const Source& source_;
  std::size_t count_, chunks_;
  std::vector<Cells> of_chunks_;
  Cells all_;
  std::vector<Region> regions_;
};

}  // namespace sdlc::render
