// Tables that every lane reads at its own index. Compiled once per instruction set, so it has no
// include guard but Highway's.
// clang-format off
#if defined(SDLC_RENDER_LANES_TABLE_READER_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef SDLC_RENDER_LANES_TABLE_READER_INL_H
#undef SDLC_RENDER_LANES_TABLE_READER_INL_H
#else
#define SDLC_RENDER_LANES_TABLE_READER_INL_H
#endif
// clang-format on

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <hwy/highway.h>

#include "render/lanes/vector_math-inl.h"

HWY_BEFORE_NAMESPACE();
namespace sdlc::render::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Reads tables at one row per lane, for several tables with the same indices.
template <typename D>
class TableReader {
 public:
  using T = hn::TFromD<D>;
  using DU = hn::RebindToUnsigned<D>;
  using Index = hn::Vec<DU>;

  HWY_INLINE TableReader(Index index, std::size_t rows)
      : index_(index), registers_((rows + kLanes - 1) / kLanes) {}

  template <typename Allocator>
  HWY_INLINE hn::Vec<D> operator()(const std::vector<T, Allocator>& table) const {
    const D d;
    if constexpr (kHasPermutation) {
      if (HWY_LIKELY(registers_ <= kMaxRegisters)) {
        return permuted(
            d, [&](std::size_t i) HWY_ATTR { return hn::Load(d, table.data() + i * kLanes); });
      }
    }
    return hn::GatherIndex(d, table.data(), hn::BitCast(DI(), index_));
  }

  /// Integers take 32 bits in the table, whatever the lane size.
  template <typename Allocator>
  HWY_INLINE Index operator()(const std::vector<std::uint32_t, Allocator>& table) const {
    const DU du;
    const hn::Rebind<std::uint32_t, D> d32;
    const hn::Rebind<std::int32_t, D> di32;
    if constexpr (kHasPermutation) {
      if (HWY_LIKELY(registers_ <= kMaxRegisters)) {
        return permuted(du, [&](std::size_t i) HWY_ATTR {
          return in_lanes(hn::Load(d32, table.data() + i * kLanes));
        });
      }
    }
    if constexpr (sizeof(T) == 4) {
      return hn::GatherIndex(d32, table.data(), hn::BitCast(di32, index_));
    } else {
      const auto index = hn::BitCast(di32, hn::TruncateTo(d32, index_));
      return in_lanes(hn::GatherIndex(d32, table.data(), index));
    }
  }

  template <typename Table>
  HWY_INLINE Triple<hn::Vec<D>> operator()(const std::array<Table, 3>& tables) const {
    return {(*this)(tables[0]), (*this)(tables[1]), (*this)(tables[2])};
  }

 private:
  using DI = hn::RebindToSigned<D>;
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  // Whether permuting whole registers by an index is a single instruction.
  static constexpr bool kHasPermutation =
      HWY_TARGET == HWY_AVX3 || (HWY_TARGET == HWY_AVX2 && sizeof(T) == 4);
  static constexpr std::size_t kMaxRegisters = 4;  // above this a gather is faster

  static HWY_INLINE Index in_lanes(auto words) {
    if constexpr (sizeof(T) == 4) {
      return words;
    } else {
      return hn::PromoteTo(DU(), words);
    }
  }

  /// `load(i)` returns the table's i-th register.
  HWY_INLINE auto permuted(auto d, const auto& load) const {
    const auto lane = hn::IndicesFromVec(d, hn::And(index_, hn::Set(DU(), kLanes - 1)));
    auto value = hn::TableLookupLanes(load(0), lane);
    for (std::size_t i = 1; i < registers_; ++i) {
      const auto last_before = static_cast<hn::TFromD<DI>>(i * kLanes - 1);
      const auto here = hn::Gt(hn::BitCast(DI(), index_), hn::Set(DI(), last_before));
      value = hn::IfThenElse(hn::RebindMask(d, here), hn::TableLookupLanes(load(i), lane), value);
    }
    return value;
  }

  Index index_;
  std::size_t registers_;
};

}  // namespace sdlc::render::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
