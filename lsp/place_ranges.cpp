#include "lsp/place_ranges.hpp"

namespace sdlc::lsp {

Json PlaceRanges::range(const lang::Place& place) {
  if (!ranges_ || place.path != path_) {
    path_ = place.path;
    ranges_.reset();
    document_ = session_.load(path_);
    if (!document_) return nullptr;
    ranges_.emplace(*document_, session_.client().encoding());
  }
  return ranges_->range(place.where);
}

}  // namespace sdlc::lsp
