#include "lsp/place_ranges.hpp"

namespace sdlc::lsp {

Json TextRanges::position(std::uint32_t offset) {
  const lang::Position position = positions_.at(offset);
  return {{"line", position.line - 1}, {"character", position.column - 1}};
}

Json TextRanges::range(lang::Span span) {
  return {{"start", position(span.begin)}, {"end", position(span.end)}};
}

Json PlaceRanges::range(const lang::Place& place) {
  if (!ranges_ || place.path != path_) {
    path_ = place.path;
    ranges_.reset();
    document_ = session_.load(path_);
    if (!document_) return nullptr;
    ranges_.emplace(session_, *document_);
  }
  return ranges_->range(place.where);
}

}  // namespace sdlc::lsp
