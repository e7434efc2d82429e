#include "lang/repair/repaired_text.hpp"

#include <algorithm>

namespace sdlc::lang {

void RepairedText::apply(std::vector<Edit> edits) {
  std::ranges::stable_sort(edits, {}, [](const Edit& edit) { return edit.span.begin; });
  std::string next;
  Round round;
  std::uint32_t copied = 0;
  for (const Edit& edit : edits) {
    if (edit.span.begin < copied) continue;
    next += std::string_view(text_).substr(copied, edit.span.begin - copied);
    const auto begin = static_cast<std::uint32_t>(next.size());
    next += edit.text;
    round.push_back({edit.span, {begin, static_cast<std::uint32_t>(next.size())}});
    copied = edit.span.end;
  }
  if (round.empty()) return;
  next += std::string_view(text_).substr(copied);
  part_.end += static_cast<std::uint32_t>(next.size() - text_.size());
  text_ = std::move(next);
  rounds_.push_back(std::move(round));
}

/// The last piece that begins at or before `at`; null if there is none.
const RepairedText::Piece* RepairedText::piece_at(const Round& round, std::uint32_t at) noexcept {
  const auto later =
      std::ranges::upper_bound(round, at, {}, [](const Piece& piece) { return piece.after.begin; });
  return later == round.begin() ? nullptr : &*std::prev(later);
}

std::uint32_t RepairedText::before(const Round& round, std::uint32_t at) noexcept {
  const Piece* piece = piece_at(round, at);
  if (piece == nullptr) return at;
  if (at >= piece->after.end) return piece->before.end + (at - piece->after.end);
  return std::min(piece->before.begin + (at - piece->after.begin), piece->before.end);
}

std::uint32_t RepairedText::in_source(std::uint32_t at) const noexcept {
  for (auto round = rounds_.rbegin(); round != rounds_.rend(); ++round) at = before(*round, at);
  return at;
}

/// The same of the end of a span: a piece that begins there is beyond it.
std::uint32_t RepairedText::end_before(const Round& round, std::uint32_t end) noexcept {
  const Piece* piece = end == 0 ? nullptr : piece_at(round, end - 1);
  if (piece == nullptr) return end;
  if (end >= piece->after.end) return piece->before.end + (end - piece->after.end);
  return std::min(piece->before.begin + (end - piece->after.begin), piece->before.end);
}

Span RepairedText::in_source(Span span) const noexcept {
  const std::uint32_t begin = in_source(span.begin);
  if (span.size() == 0) return {begin, begin};
  std::uint32_t end = span.end;
  for (auto round = rounds_.rbegin(); round != rounds_.rend(); ++round) {
    end = end_before(*round, end);
  }
  return {begin, std::max(begin, end)};
}

bool RepairedText::is_reported(std::uint32_t at) const noexcept {
  const std::uint32_t place = in_source(at);
  return std::ranges::any_of(reported_,
                             [&](Span span) { return span.begin <= place && place < span.end; });
}

bool RepairedText::is_added(std::uint32_t at) const noexcept {
  for (auto round = rounds_.rbegin(); round != rounds_.rend(); ++round) {
    const Piece* piece = piece_at(*round, at);
    const std::uint32_t place = before(*round, at);
    if (piece != nullptr && at < piece->after.end && place >= piece->before.end) return true;
    at = place;
  }
  return false;
}

}  // namespace sdlc::lang
