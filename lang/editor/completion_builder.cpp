#include "lang/editor/completion_builder.hpp"

#include <algorithm>
#include <set>
#include <tuple>
#include <utility>

#include "lang/text/ascii.hpp"
#include "lang/token/token_reader.hpp"

namespace sdlc::lang {
namespace {

/// How the typed characters occur in a label.
enum Match : int { kPrefix, kPart, kSubsequence, kNone };

bool starts_with(std::string_view text, std::string_view prefix) {
  return text.size() >= prefix.size() &&
         std::ranges::equal(text.substr(0, prefix.size()), prefix, {}, to_lower, to_lower);
}

/// Whether a word of the label begins at `i`.
bool begins_part(std::string_view label, std::size_t i) {
  return i == 0 || label[i - 1] == '_' || label[i - 1] == '.' || label[i - 1] == ' ' ||
         label[i - 1] == '/';
}

/// Whether the characters occur in this order.
bool is_subsequence(std::string_view typed, std::string_view label) {
  for (const char c : label) {
    if (!typed.empty() && to_lower(c) == to_lower(typed.front())) typed.remove_prefix(1);
  }
  return typed.empty();
}

Match match(std::string_view typed, std::string_view label) {
  if (starts_with(label, typed)) return kPrefix;
  Match best = kNone;
  for (std::size_t i = 1; i < label.size(); ++i) {
    const std::string_view part = label.substr(i);
    if (begins_part(label, i) && starts_with(part, typed)) return kPart;
  }
  // More letters would accept nearly everything.
  for (std::size_t i = 0; i < label.size() && typed.size() > 1; ++i) {
    const bool begins = begins_part(label, i) && to_lower(label[i]) == to_lower(typed.front());
    if (begins && is_subsequence(typed, label.substr(i))) best = kSubsequence;
  }
  return best;
}

}  // namespace

CompletionBuilder::CompletionBuilder(SceneView& view, std::uint32_t file, const CursorPlace& place)
    : view_(view),
      file_(file),
      place_(place),
      text_(view.file(file).text()),
      replaced_(place.word),
      prefix_(place.prefix(text_)) {}

void CompletionBuilder::set_replaced(Span replaced) {
  replaced_ = replaced;
  prefix_ = text_.substr(replaced.begin, place_.offset - replaced.begin);
}

bool CompletionBuilder::accepts(std::string_view label) const {
  return match(prefix_, label) != kNone;
}

void CompletionBuilder::add(CompletionItem item, CompletionRank rank) {
  const Match found = match(prefix_, item.label);
  if (found == kNone) return;
  if (item.text.empty()) item.text = item.label;
  item.replaced = replaced_;
  ranked_.push_back({std::move(item), rank, found});
}

bool CompletionBuilder::is_followed_by(char c) const {
  const std::uint32_t next = std::max(place_.offset, place_.word.end);
  if (place_.word.size() == 0) return false;
  const std::uint32_t at = c == '(' ? next : skip_space(text_, next);
  return at < text_.size() && text_[at] == c;
}

CompletionList CompletionBuilder::take() {
  constexpr std::size_t kMaxItems = 200;  // 50 KB of JSON
  const auto key = [](const Ranked* r) {
    return std::tie(r->rank.fit, r->match, r->rank.distance, r->item.label);
  };
  // The items are large: sort pointers to them.
  std::vector<Ranked*> order;
  for (Ranked& ranked : ranked_) order.push_back(&ranked);
  std::ranges::stable_sort(order,
                           [&](const Ranked* a, const Ranked* b) { return key(a) < key(b); });
  CompletionList list;
  std::set<std::pair<CompletionKind, std::string_view>> known;
  for (Ranked* ranked : order) {
    list.is_incomplete = list.items.size() == kMaxItems;
    if (list.is_incomplete) break;
    if (!known.emplace(ranked->item.kind, ranked->item.label).second) continue;
    list.items.push_back(ranked->item);
  }
  return list;
}

}  // namespace sdlc::lang
