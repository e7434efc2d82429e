#include "lang/text/bracket_repair.hpp"

#include <algorithm>
#include <deque>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "lang/source/limits.hpp"
#include "lang/text/brackets.hpp"

// A search with a beam: from token to token it keeps the cheapest explanations of the text so far.
// A mistake costs most; what a tidy text would not have costs a little, and tells where among
// several places the mistake was made.
namespace sdlc::lang {
namespace {

namespace cost {
constexpr int kFault = 20;
constexpr int kSurplusOpen = 23;
constexpr int kSurplusClose = 21;
constexpr int kDoubled = 17;       ///< a bracket typed twice
constexpr int kGuessedOpen = 22;   ///< an opening bracket that nothing asks for
constexpr int kImpossible = 60;    ///< a block in a parenthesis, a config behind the end of one
constexpr int kWanted = 12;        ///< an opening bracket that is asked for and does not come
constexpr int kStatement = 16;     ///< a statement inside a parenthesis
constexpr int kLabel = 12;         ///< a label where no arguments are
constexpr int kValueBehind = 5;    ///< a value behind arguments with labels
constexpr int kNoDefinition = 12;  ///< parameters, and nothing that they are for
constexpr int kTrailingComma = 2;  ///< an object or list of JSON that ends with a comma
constexpr int kNoComma = 3;        ///< a label of a block behind a value in the same line
constexpr int kMissingComma = 10;  ///< a label right behind a value of the same parenthesis
constexpr int kLabelBehind = 4;    ///< a label behind arguments without any
constexpr int kLabelBeyond = 3;    ///< a label that might have been one more argument with a label
constexpr int kStray = 12;
constexpr int kShallow = 9;     ///< a line that is not deeper than the block it stands in
constexpr int kUneven = 6;      ///< a line indented otherwise than those before it in the block
constexpr int kUnevenEnd = 6;   ///< a line's first bracket closes one of another indentation
constexpr int kHangingEnd = 3;  ///< it closes one behind which its line goes on
constexpr int kHiddenEnd = 2;   ///< a bracket of several lines is closed behind others
constexpr int kOutside = 6;     ///< a property outside of any block
}  // namespace cost

// The corpora of planted errors and of mutated texts pass with half as many and with four times as
// many.
constexpr std::size_t kBeam = 24;
constexpr int kHopeless = 64;  ///< behind the cheapest
/// What is nested deeper is refused whatever its brackets are; a wrong explanation may be deeper
/// than the right one.
constexpr int kDeepest = 2 * kMaxNesting;
constexpr std::size_t kMostFaults = 24;
constexpr int kMostCost = 40 * static_cast<int>(kMostFaults);  ///< a text beyond that is no text

bool is_parenthesis(char open) noexcept { return open != '{' && open != '\0'; }
bool matches(char open, char close) noexcept {
  if (open == '?') return close != '}';
  return is_bracket_pair(open, close);
}

/// A bracket that is open. `?` stands for a parenthesis or list whose opening bracket is missing.
struct Frame {
  const Frame* outer = nullptr;
  std::uint32_t opener = 0;
  std::uint32_t line = 0;
  std::uint32_t indent = 0;
  std::int64_t child_indent = -1;  ///< of the lines inside; -1: none yet
  int depth = 0;
  char open = '\0';
  bool is_added = false;  ///< the text lacks it
  bool is_call = false;
  bool is_head = false;
  bool ends_line = false;  ///< nothing stands behind it in its line
  bool has_values = false;
  bool has_labels = false;
  std::uint64_t hash = 0;
};

struct Step {
  const Step* before = nullptr;
  BracketFault fault;
};

/// One explanation of the text so far.
struct Hypothesis {
  const Frame* frame = nullptr;
  const Step* steps = nullptr;
  int cost = 0;
  std::size_t next = 0;  ///< the tokens before it have been taken
};

/// Linked lists that share their ends.
template <typename Node, const Node* Node::*kNext>
class SharedLists {
 public:
  const Node* push(const Node& node) { return &nodes_.emplace_back(node); }
  std::size_t size() const { return nodes_.size(); }

  /// Moves the lists that are kept over from `old`, each node once.
  const Node* keep(const Node* list) {
    std::vector<const Node*> unknown;
    for (; list != nullptr && !moved_.contains(list); list = list->*kNext) unknown.push_back(list);
    const Node* end = list == nullptr ? nullptr : moved_.at(list);
    for (auto node = unknown.rbegin(); node != unknown.rend(); ++node) {
      Node copy = **node;
      copy.*kNext = end;
      end = moved_[*node] = push(copy);
    }
    return end;
  }

 private:
  std::deque<Node> nodes_;
  std::unordered_map<const Node*, const Node*> moved_;  ///< from the lists before
};

/// Whether most blocks of several lines are deeper than the lines that open them; if not,
/// indentation means nothing.
bool is_tidy(std::span<const LayoutToken> tokens) {
  std::size_t blocks = 0, deep = 0;
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    const LayoutToken &open = tokens[i], &inside = tokens[i + 1];
    if (open.bracket != '{' || !inside.is_first || inside.kind == LayoutKind::Close) continue;
    ++blocks;
    deep += inside.indent > open.indent;
  }
  return deep * 2 >= blocks;
}

class Search {
 public:
  Search(std::span<const LayoutToken> tokens, BlockPlace blocks)
      : tokens_(tokens), are_values_(blocks == BlockPlace::Values), is_tidy_(is_tidy(tokens)) {}

  std::optional<std::vector<BracketFault>> run() {
    beam_ = {{.frame = push(nullptr, {})}};
    for (at_ = 0; at_ <= tokens_.size(); ++at_) {
      next_.clear();
      for (const Hypothesis& hypothesis : beam_) advance(hypothesis, 0);
      prune();
      settle();
      forget();
      if (beam_.empty() || beam_.front().cost > kMostCost) return std::nullopt;
    }
    std::vector<BracketFault> faults;
    for (const Step* step = beam_.front().steps; step != nullptr; step = step->before) {
      faults.push_back(step->fault);
    }
    std::reverse(faults.begin(), faults.end());
    return faults;
  }

 private:
  bool is_at_end() const { return at_ == tokens_.size(); }
  const LayoutToken& token() const { return tokens_[at_]; }
  const LayoutToken* before() const { return at_ == 0 ? nullptr : &tokens_[at_ - 1]; }
  bool is_behind(LayoutKind kind) const { return at_ > 0 && tokens_[at_ - 1].kind == kind; }

  const Frame* push(const Frame* outer, Frame frame) {
    frame.outer = outer;
    frame.depth = outer == nullptr ? 0 : outer->depth + 1;
    std::uint64_t hash = outer == nullptr ? 0 : outer->hash;
    const auto mix = [&](std::uint64_t word) {
      hash = (hash ^ word) * 0x9E3779B97F4A7C15;
      hash ^= hash >> 29;
    };
    mix(frame.opener);
    mix(static_cast<std::uint64_t>(frame.child_indent + 1));
    mix(static_cast<std::uint64_t>(frame.open) * 4 + frame.has_values * 2 + frame.has_labels);
    frame.hash = hash;
    return frames_.push(frame);
  }

  Hypothesis with(Hypothesis hypothesis, BracketFault fault, int price) {
    hypothesis.steps = steps_.push({hypothesis.steps, fault});
    hypothesis.cost += price;
    return hypothesis;
  }

  // Ways to go on

  void advance(const Hypothesis& hypothesis, int depth) {
    if (hypothesis.next > at_) return next_.push_back(hypothesis);
    constexpr int kMostAtOnePlace = 6;
    if (depth < kMostAtOnePlace) {
      if (may_close(*hypothesis.frame)) advance(closed(hypothesis), depth + 1);
      if (!is_at_end() && depth == 0) open_missing(hypothesis);
    }
    if (is_at_end()) {
      if (hypothesis.frame->outer == nullptr) next_.push_back(hypothesis);
      return;
    }
    if (token().kind == LayoutKind::Open || token().kind == LayoutKind::Close) skip(hypothesis);
    if (token().kind == LayoutKind::Close) exchange(hypothesis);
    consume(hypothesis);
  }

  /// A bracket that closes another kind than the open one: it stands in that one's place, or the
  /// two closing brackets here are swapped.
  void exchange(const Hypothesis& hypothesis) {
    const Frame& frame = *hypothesis.frame;
    const bool is_wrong =
        frame.outer != nullptr && !frame.is_added && !matches(frame.open, token().bracket);
    if (!is_wrong) return;
    Hypothesis replaced = with(hypothesis,
                               {.kind = BracketFault::MissingClose,
                                .bracket = closing_bracket(frame.open),
                                .token = here_index(),
                                .partner = frame.opener},
                               cost::kFault + price_of_end(frame));
    replaced =
        with(replaced,
             {.kind = BracketFault::Surplus, .bracket = token().bracket, .token = here_index()}, 0);
    replaced.frame = frame.outer;
    next_.push_back(replaced);

    const bool is_swapped = at_ + 1 < tokens_.size() && frame.outer->outer != nullptr &&
                            tokens_[at_ + 1].kind == LayoutKind::Close &&
                            matches(frame.open, tokens_[at_ + 1].bracket) &&
                            matches(frame.outer->open, token().bracket);
    if (!is_swapped) return;
    Hypothesis swapped = with(hypothesis,
                              {.kind = BracketFault::Swapped,
                               .bracket = closing_bracket(frame.open),
                               .token = here_index(),
                               .partner = frame.opener},
                              cost::kFault);
    swapped.frame = frame.outer->outer;
    swapped.next = at_ + 2;
    next_.push_back(swapped);
  }

  bool may_close(const Frame& frame) const {
    if (frame.outer == nullptr || frame.open == '?') return false;
    if (is_at_end() || token().is_first || (frame.is_head && token().defines)) return true;
    const bool is_in_parenthesis = is_parenthesis(frame.open);
    switch (token().kind) {
      case LayoutKind::Close: return !matches(frame.open, token().bracket);
      case LayoutKind::Open: return is_in_parenthesis && !are_values_ && token().bracket == '{';
      case LayoutKind::Statement: return is_in_parenthesis;
      case LayoutKind::Label: return is_in_parenthesis && !is_behind(LayoutKind::Comma);
      case LayoutKind::Comma: return may_close_before_comma(frame);
      default: return false;
    }
  }

  bool may_close_before_comma(const Frame& frame) const {
    if (at_ + 1 == tokens_.size()) return false;
    const LayoutToken& behind = tokens_[at_ + 1];
    if (is_parenthesis(frame.open) && behind.kind == LayoutKind::Label) return true;
    return are_values_ && (behind.is_first || behind.kind == LayoutKind::Open);
  }

  Hypothesis closed(const Hypothesis& hypothesis) {
    const Frame& frame = *hypothesis.frame;
    Hypothesis next = with(hypothesis,
                           {.kind = BracketFault::MissingClose,
                            .bracket = closing_bracket(frame.open),
                            .token = static_cast<std::uint32_t>(at_),
                            .partner = frame.is_added ? BracketFault::kNone : frame.opener},
                           cost::kFault + price_of_early_end(frame));
    next.frame = frame.outer;
    return next;
  }

  void open_missing(const Hypothesis& hypothesis) {
    const LayoutToken& here = token();
    const bool is_in_block = !is_parenthesis(hypothesis.frame->open);
    const bool is_wanted = here.wanted == '(' || (here.wanted == '{' && is_in_block);
    // Of a list of objects, one may lack its brace.
    const bool is_member = are_values_ && !is_in_block && here.kind == LayoutKind::Label;
    if (at_ == 0 || (!is_wanted && !here.may_open && !is_member)) return;
    const char open = (here.wanted == '{' && is_wanted) || is_member ? '{' : '?';
    Hypothesis next = with(
        hypothesis, {.kind = BracketFault::MissingOpen, .bracket = open, .token = here_index()},
        is_wanted || is_member ? cost::kFault : cost::kGuessedOpen);
    const LayoutToken* last = before();
    // It stands between the last token and this one.
    next.frame = push(hypothesis.frame, {.opener = here_index() - 1,
                                         .line = is_member ? here.line : last->line,
                                         .indent = last->indent,
                                         .open = open,
                                         .is_added = true,
                                         .is_call = true,
                                         .ends_line = here.is_first});
    consume(next, true);
  }

  std::uint32_t here_index() const { return static_cast<std::uint32_t>(at_); }

  void skip(const Hypothesis& hypothesis) {
    const LayoutToken* last = before();
    const bool is_doubled = last != nullptr && last->kind == token().kind &&
                            last->bracket == token().bracket && last->end == token().begin;
    next_.push_back(
        with(hypothesis,
             {.kind = BracketFault::Surplus, .bracket = token().bracket, .token = here_index()},
             is_doubled                         ? cost::kDoubled
             : token().kind == LayoutKind::Open ? cost::kSurplusOpen
                                                : cost::kSurplusClose));
  }

  // What the token costs where it stands

  void consume(Hypothesis hypothesis, bool is_opened = false) {
    const LayoutToken& here = token();
    const Frame& frame = *hypothesis.frame;
    const bool is_in_parenthesis = is_parenthesis(frame.open);
    if (here.kind == LayoutKind::Close) {
      if (!matches(frame.open, here.bracket)) return;
      hypothesis.cost += price_of_end(frame);
      hypothesis.frame = frame.outer;
      next_.push_back(hypothesis);
      return;
    }
    if (here.wanted != '\0' && !is_opened && !(here.wanted == '{' && is_in_parenthesis)) {
      hypothesis.cost += cost::kWanted;
    }
    hypothesis.cost += is_in_parenthesis ? price_in_parenthesis(frame) : price_in_block(frame);
    hypothesis.frame = noted(frame);
    if (here.kind == LayoutKind::Open) {
      if (hypothesis.frame->depth == kDeepest) return;
      hypothesis.frame = push(hypothesis.frame, opened());
    }
    next_.push_back(hypothesis);
  }

  /// The frame with what the token tells of its content.
  const Frame* noted(const Frame& frame) {
    const LayoutToken& here = token();
    Frame known = frame;
    const bool is_line = here.is_first && !here.continues && !is_parenthesis(frame.open);
    if (is_line && frame.child_indent < 0) known.child_indent = here.indent;
    const bool is_argument =
        is_behind(LayoutKind::Comma) || static_cast<std::uint32_t>(frame.opener + 1) == at_;
    const bool is_label = here.kind == LayoutKind::Label;
    if (is_argument && !is_label) known.has_values = true;
    if (is_label && is_parenthesis(frame.open)) known.has_labels = true;
    const bool is_new = known.child_indent != frame.child_indent ||
                        known.has_values != frame.has_values ||
                        known.has_labels != frame.has_labels;
    return is_new ? push(frame.outer, known) : &frame;
  }

  Frame opened() const {
    const LayoutToken& here = token();
    return {.opener = here_index(),
            .line = here.line,
            .indent = here.indent,
            .open = here.bracket,
            .is_call = here.is_call,
            .is_head = here.is_head,
            .ends_line = at_ + 1 == tokens_.size() || tokens_[at_ + 1].is_first};
  }

  int price_of_early_end(const Frame& frame) const {
    if (frame.is_head && (is_at_end() || !token().defines)) return cost::kNoDefinition;
    if (are_values_ && is_behind(LayoutKind::Comma)) return cost::kTrailingComma;
    const bool ends_here = !is_at_end() && token().kind == LayoutKind::Comma;
    return ends_here && frame.is_call && !frame.has_values ? cost::kLabelBeyond : 0;
  }

  int price_of_end(const Frame& frame) const {
    const LayoutToken& here = token();
    const bool is_followed = at_ + 1 < tokens_.size() && tokens_[at_ + 1].defines;
    if (frame.is_head && !is_followed) return cost::kNoDefinition;
    if (here.line == frame.line) return 0;
    if (!here.is_first) return frame.ends_line ? cost::kHiddenEnd : 0;
    int price = here.indent == frame.indent || !is_tidy_ ? 0 : cost::kUnevenEnd;
    if (!frame.ends_line) price += cost::kHangingEnd;
    return price;
  }

  int price_in_block(const Frame& frame) const {
    const LayoutToken& here = token();
    const bool is_behind_all = are_values_ && frame.outer == nullptr && at_ > 0;
    if (is_behind_all) return cost::kImpossible;
    int price = here.is_stray ? cost::kStray : 0;
    const bool is_outside = frame.outer == nullptr && here.kind == LayoutKind::Label;
    if (is_outside) price += cost::kOutside;
    if (here.kind == LayoutKind::Label && !here.is_first) {
      if (is_behind(LayoutKind::Label)) price += cost::kLabel;
      if (is_behind(LayoutKind::Value)) price += cost::kNoComma;
    }
    if (!here.is_first || here.continues || !is_tidy_) return price;
    const bool is_shallow =
        frame.outer != nullptr && here.line > frame.line && here.indent <= frame.indent;
    if (is_shallow) return price + cost::kShallow;
    const bool is_uneven = frame.child_indent >= 0 && here.indent != frame.child_indent;
    return price + (is_uneven ? cost::kUneven : 0);
  }

  int price_in_parenthesis(const Frame& frame) const {
    const LayoutToken& here = token();
    const bool is_block = here.kind == LayoutKind::Open && here.bracket == '{';
    if (is_block && !are_values_) return cost::kImpossible;
    if (here.kind == LayoutKind::Statement) return cost::kStatement;
    if (here.kind != LayoutKind::Label) {
      const bool is_behind = frame.has_labels && !frame.is_head && is_behind_comma();
      return is_behind ? cost::kValueBehind : 0;
    }
    int price = frame.is_call ? 0 : cost::kLabel;
    const bool is_shallow = here.is_first && here.indent <= frame.indent;
    if (is_shallow) price += cost::kShallow;
    const bool is_apart =
        static_cast<std::uint32_t>(frame.opener + 1) == at_ || is_behind(LayoutKind::Comma);
    if (!is_apart) price += cost::kMissingComma;
    if (frame.has_values && !frame.is_head) price += cost::kLabelBehind;
    return price;
  }

  /// Whether the token is the first of another argument.
  bool is_behind_comma() const {
    return is_behind(LayoutKind::Comma) && token().kind != LayoutKind::Close;
  }

  // The beam

  void prune() {
    std::stable_sort(next_.begin(), next_.end(),
                     [](const Hypothesis& a, const Hypothesis& b) { return a.cost < b.cost; });
    beam_.clear();
    for (const Hypothesis& hypothesis : next_) {
      if (beam_.size() == kBeam || hypothesis.cost > next_.front().cost + kHopeless) break;
      const bool is_known = std::any_of(beam_.begin(), beam_.end(), [&](const Hypothesis& other) {
        return other.frame->hash == hypothesis.frame->hash && other.next == hypothesis.next;
      });
      if (!is_known) beam_.push_back(hypothesis);
    }
  }

  /// Behind a statement of the file that reads without surprise, what came before is explained.
  void settle() {
    const bool begins_statement = !are_values_ && is_tidy_ && at_ + 1 < tokens_.size() &&
                                  tokens_[at_ + 1].is_first && tokens_[at_ + 1].indent == 0;
    if (!begins_statement || beam_.empty() || beam_.front().frame->outer != nullptr) return;
    const int cost = beam_.front().cost;
    if (cost == settled_cost_) {
      std::erase_if(beam_, [&](const Hypothesis& other) { return other.cost > cost; });
    }
    settled_cost_ = cost;
  }

  /// Frees the frames and steps that no hypothesis leads to.
  void forget() {
    constexpr std::size_t kMostNodes = 100'000;
    if (frames_.size() + steps_.size() < kMostNodes) return;
    SharedLists<Frame, &Frame::outer> frames;
    SharedLists<Step, &Step::before> steps;
    for (Hypothesis& hypothesis : beam_) {
      hypothesis.frame = frames.keep(hypothesis.frame);
      hypothesis.steps = steps.keep(hypothesis.steps);
    }
    frames_ = std::move(frames);
    steps_ = std::move(steps);
  }

  std::span<const LayoutToken> tokens_;
  bool are_values_;
  bool is_tidy_;
  std::size_t at_ = 0;
  std::vector<Hypothesis> beam_, next_;
  int settled_cost_ = 0;  ///< of the cheapest, where the last statement of the file began
  SharedLists<Frame, &Frame::outer> frames_;
  SharedLists<Step, &Step::before> steps_;
};

/// Goes through the text as it is mended: what an opening bracket that was missing is, where the
/// brackets of each pair are, and which pairs stand in a value with a fault.
class Replay {
 public:
  Replay(std::span<const LayoutToken> tokens, std::vector<BracketFault> faults)
      : tokens_(tokens), repair_{.faults = std::move(faults), .uncertain = {}} {}

  BracketRepair run() {
    for (at_ = 0; at_ <= tokens_.size(); ++at_) {
      bool is_skipped = false;
      for (; next_ < repair_.faults.size() && repair_.faults[next_].token == at_; ++next_) {
        is_skipped = is_skipped || repair_.faults[next_].kind == BracketFault::Surplus;
        take(next_);
      }
      if (at_ < tokens_.size() && !is_skipped && at_ >= swapped_) read(tokens_[at_]);
    }
    for (const auto& [token, value] : ends_) {
      if (faulty_.contains(value)) repair_.uncertain.push_back(token);
    }
    return std::move(repair_);
  }

 private:
  struct Open {
    std::uint32_t token;
    std::size_t fault = kNoFault;  ///< that says it is missing
    char bracket;
  };
  static constexpr std::size_t kNoFault = static_cast<std::size_t>(-1);

  bool is_in_block() const { return open_.empty() || open_.back().bracket == '{'; }

  void take(std::size_t index) {
    BracketFault& fault = repair_.faults[index];
    switch (fault.kind) {
      case BracketFault::Surplus:
        if (fault.bracket != '{' && fault.bracket != '}') faulty_.insert(value_);
        break;
      case BracketFault::MissingOpen:
        if (fault.bracket != '{') faulty_.insert(value_);
        open_.push_back({static_cast<std::uint32_t>(at_), index, fault.bracket});
        break;
      case BracketFault::MissingClose:
        if (fault.bracket != '}') faulty_.insert(value_);
        if (!open_.empty()) open_.pop_back();
        break;
      case BracketFault::Swapped:
        faulty_.insert(value_);
        swapped_ = at_ + 2;
        for (int i = 0; i < 2 && !open_.empty(); ++i) open_.pop_back();
        break;
      case BracketFault::MissingMark:
      case BracketFault::MissingThird: break;  // those are found later
    }
  }

  void read(const LayoutToken& token) {
    const bool is_boundary = token.kind == LayoutKind::Label ||
                             token.kind == LayoutKind::Statement ||
                             (token.is_first && !token.continues);
    if (is_in_block() && is_boundary) ++value_;
    if (token.kind == LayoutKind::Open) {
      open_.push_back({static_cast<std::uint32_t>(at_), kNoFault, token.bracket});
    } else if (token.kind == LayoutKind::Close && !open_.empty()) {
      const Open opener = open_.back();
      open_.pop_back();
      if (opener.fault != kNoFault) {
        repair_.faults[opener.fault].partner = static_cast<std::uint32_t>(at_);
        if (opener.bracket == '?') {
          repair_.faults[opener.fault].bracket = token.bracket == ']' ? '[' : '(';
        }
      }
      if (token.bracket != '}') ends_.emplace_back(static_cast<std::uint32_t>(at_), value_);
    }
  }

  std::span<const LayoutToken> tokens_;
  BracketRepair repair_;
  std::size_t at_ = 0, next_ = 0;
  std::size_t value_ = 0;    ///< the number of the value that is being read
  std::size_t swapped_ = 0;  ///< the tokens before it have been taken
  std::vector<Open> open_;
  std::unordered_set<std::size_t> faulty_;  ///< values
  std::vector<std::pair<std::uint32_t, std::size_t>> ends_;
};

}  // namespace

BracketRepair repair_brackets(std::span<const LayoutToken> tokens, BlockPlace blocks) {
  auto faults = Search(tokens, blocks).run();
  if (!faults || faults->empty() || faults->size() > kMostFaults) return {};
  return Replay(tokens, std::move(*faults)).run();
}

}  // namespace sdlc::lang
