#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "render/denoise/cross_filter.cpp"
#include <hwy/foreach_target.h>

#include "render/denoise/filter_tile-inl.h"

#if HWY_ONCE
namespace sdlc::render {

std::vector<FilteredPixel> portable_filter(const ReplicatePlanes& planes, const TileArea& area) {
  return HWY_STATIC_DISPATCH(filter_tile)(planes, area);
}

}  // namespace sdlc::render
#endif
