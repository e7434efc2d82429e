#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <tbb/parallel_for.h>

#include "render/wide/bins.hpp"
#include "render/wide/bvh_members.hpp"

namespace sdlc::render {

/// Divides very many members among the children of a node, on all threads. Members are counted in
/// the cells of a grid, then cells are divided instead of members, and then each member is written
/// to where its group begins: three times each is looked at, instead of three times for each of
/// the four levels of a node.
///
/// `source(i)` gives each of `count` members. They are handled in ranges that do not depend on
/// threads, and what comes of those is put together in their order.
template <typename T, typename Source>
class GridSplit {
 public:
  GridSplit(const Source& source, std::size_t count)
      : source_(source),
        count_(count),
        ranges_(std::clamp<std::size_t>(count / kMembersARange, 1, kMostRanges)) {}

  /// Writes the members to `to`, of which `begin` is the first place. One group where all middles
  /// are in one place.
  NodeGroups<T> split(std::span<Member<T>> to, std::size_t begin) {
    const BinScale<T> scale(middles());
    count_cells(scale);
    divide_cells();
    NodeGroups<T> groups;
    for (const Region& region : regions_) {
      Group<T>& group = groups.of[groups.count++];
      group = {.begin = begin, .end = begin + region.count, .box = region.box};
      begin = group.end;
    }
    write(scale, groups, to);
    return groups;
  }

 private:
  static constexpr std::size_t kCells = kBins * kBins * kBins;
  static constexpr std::size_t kMembersARange = 16384, kMostRanges = 64;
  static constexpr std::size_t kFewest = 64;  // less are not divided: cells are too coarse for them

  struct Cells {
    std::vector<BuildBox<T>> boxes = std::vector<BuildBox<T>>(kCells);
    std::vector<std::uint32_t> counts = std::vector<std::uint32_t>(kCells);
  };

  /// The cells from `low` to before `high` along each axis, and what is in them.
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

  /// body(range, member) for each member, with the ranges side by side.
  template <typename Body>
  void for_members(const Body& body) const {
    tbb::parallel_for(std::size_t{0}, ranges_, [&](std::size_t range) {
      const std::size_t end = count_ * (range + 1) / ranges_;
      for (std::size_t i = count_ * range / ranges_; i < end; ++i) body(range, source_(i));
    });
  }

  BuildBox<T> middles() const {
    std::vector<BuildBox<T>> of_ranges(ranges_);
    for_members([&](std::size_t range, const Member<T>& member) {
      of_ranges[range].add(member.middles());
    });
    BuildBox<T> all;
    for (const BuildBox<T>& box : of_ranges) all.add(box);
    return all;
  }

  void count_cells(const BinScale<T>& scale) {
    of_ranges_.resize(ranges_);
    for_members([&](std::size_t range, const Member<T>& member) {
      const std::size_t cell = cell_of(scale.bins_of(member));
      of_ranges_[range].boxes[cell].add(member.box());
      ++of_ranges_[range].counts[cell];
    });
    all_ = of_ranges_[0];
    for (std::size_t range = 1; range < ranges_; ++range) {
      for (std::size_t cell = 0; cell < kCells; ++cell) {
        all_.boxes[cell].add(of_ranges_[range].boxes[cell]);
        all_.counts[cell] += of_ranges_[range].counts[cell];
      }
    }
  }

  void divide_cells() {
    Region whole{.box = {}, .count = count_};
    for (const BuildBox<T>& box : all_.boxes) whole.box.add(box);
    regions_ = {whole};
    const auto area = [](const Region& r) { return r.is_divisible ? r.box.half_area() : T{-1}; };
    while (regions_.size() < kBvhWidth) {
      // The largest box first, as everywhere.
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

  void write(const BinScale<T>& scale, const NodeGroups<T>& groups, std::span<Member<T>> to) const {
    std::vector<std::uint8_t> group_of_cell(kCells);
    // Where each range goes on to write, for each group.
    std::vector<std::array<std::size_t, kBvhWidth>> next(ranges_);
    for (std::size_t group = 0; group < groups.count; ++group) {
      std::vector<std::size_t> in_range(ranges_);
      for_cells(regions_[group], [&](const std::array<std::size_t, 3>& /*bin*/, std::size_t cell) {
        group_of_cell[cell] = static_cast<std::uint8_t>(group);
        for (std::size_t i = 0; i < ranges_; ++i) in_range[i] += of_ranges_[i].counts[cell];
      });
      std::size_t place = groups.of[group].begin;
      for (std::size_t i = 0; i < ranges_; ++i) {
        next[i][group] = place;
        place += in_range[i];
      }
    }
    for_members([&](std::size_t range, const Member<T>& member) {
      const std::size_t cell = cell_of(scale.bins_of(member));
      to[next[range][group_of_cell[cell]]++] = member;
    });
  }

  const Source& source_;
  std::size_t count_, ranges_;
  std::vector<Cells> of_ranges_;
  Cells all_;
  std::vector<Region> regions_;
};

}  // namespace sdlc::render
