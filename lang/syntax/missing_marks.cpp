#include "lang/syntax/missing_marks.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lang/schema/type_names.hpp"

namespace sdlc::lang {
namespace {

/// Goes through the text with its brackets as they are mended.
class MarkSearch {
 public:
  MarkSearch(std::string_view text, std::span<const LayoutToken> tokens, BracketRepair& repair)
      : text_(text), tokens_(tokens), repair_(repair) {}

  void run() {
    std::vector<BracketFault> faults = std::exchange(repair_.faults, {});
    auto fault = faults.begin();
    for (at_ = 0; at_ < tokens_.size(); ++at_) {
      bool is_surplus = false, is_sound = true;
      for (; fault != faults.end() && fault->token == at_; ++fault) {
        is_sound = false;
        is_surplus = is_surplus || fault->kind == BracketFault::Surplus;
        if (fault->kind == BracketFault::MissingOpen) open_.push_back({.bracket = '?'});
        if (fault->kind == BracketFault::MissingClose && !open_.empty()) open_.pop_back();
        is_surplus = is_surplus || fault->kind == BracketFault::Swapped;
        if (fault->kind == BracketFault::Swapped && open_.size() > 1) open_.pop_back();
        repair_.faults.push_back(*fault);
      }
      if (!is_surplus) read(tokens_[at_], is_sound);
    }
    repair_.faults.insert(repair_.faults.end(), fault, faults.end());
    std::sort(repair_.uncertain.begin(), repair_.uncertain.end());
    const auto repeated = std::unique(repair_.uncertain.begin(), repair_.uncertain.end());
    repair_.uncertain.erase(repeated, repair_.uncertain.end());
  }

 private:
  struct Open {
    char bracket = '\0';
    std::uint32_t token = 0;
    std::uint32_t commas = 0;
    bool is_plain = false;  ///< neither a call nor the head of a definition
    bool is_call = false;
    bool is_head = false;
    bool has_labels = false;
    bool has_fault = false;
  };

  void read(const LayoutToken& token, bool is_sound) {
    const bool is_parenthesis = !open_.empty() &&
                                (open_.back().bracket == '(' || open_.back().bracket == '[') &&
                                !is_loop(open_.back());
    if (is_parenthesis && is_sound) look(token);
    if (token.kind == LayoutKind::Open) {
      const bool is_plain = token.bracket == '(' && !token.is_call && !token.is_head;
      open_.push_back({.bracket = token.bracket,
                       .token = at_,
                       .is_plain = is_plain,
                       .is_call = token.is_call && !token.is_head,
                       .is_head = token.is_head});
    } else if (token.kind == LayoutKind::Close && !open_.empty()) {
      if (open_.back().has_fault) repair_.uncertain.push_back(at_);
      open_.pop_back();
    }
  }

  /// Whether it is the head of a `for` of another language.
  bool is_loop(const Open& open) const {
    if (open.token == 0) return false;
    const LayoutToken& word = tokens_[open.token - 1];
    return text_.substr(word.begin, word.end - word.begin) == "for";
  }

  void look(const LayoutToken& token) {
    Open& open = open_.back();
    // A point has three values: a fourth is too much, and lacks no comma.
    const bool is_full = open.is_plain && open.commas > 1;
    if (token.is_apart && at_ != open.token + 1 && !is_full) {
      add(BracketFault::MissingMark, mark_before(open));
    }
    if (token.kind == LayoutKind::Comma) ++open.commas;
    if (token.kind == LayoutKind::Label) open.has_labels = true;
    const bool is_pair = token.kind == LayoutKind::Close && open.is_plain && open.commas == 1 &&
                         tokens_[at_ - 1].kind != LayoutKind::Comma;
    if (is_pair && !open.has_fault) add(BracketFault::MissingThird, ',');
  }

  /// A colon behind what may be the name of an argument or has a type behind it; else a comma.
  char mark_before(Open& open) const {
    const LayoutToken &first = tokens_[at_ - 1], &before = tokens_[at_ - 2];
    const bool may_be_label =
        first.is_callable && (before.kind == LayoutKind::Comma || before.kind == LayoutKind::Open);
    const bool is_label = may_be_label && (open.is_call || (open.is_head && is_type()));
    if (!is_label) ++open.commas;
    return is_label ? ':' : ',';
  }

  /// Whether the token is the name of a type.
  bool is_type() const {
    const LayoutToken& token = tokens_[at_];
    return is_type_name(text_.substr(token.begin, token.end - token.begin));
  }

  void add(BracketFault::Kind kind, char mark) {
    Open& open = open_.back();
    open.has_fault = true;
    repair_.faults.push_back({.kind = kind, .bracket = mark, .token = at_, .partner = open.token});
  }

  std::string_view text_;
  std::span<const LayoutToken> tokens_;
  BracketRepair& repair_;
  std::uint32_t at_ = 0;
  std::vector<Open> open_;
};

}  // namespace

void find_missing_marks(std::string_view text, std::span<const LayoutToken> tokens,
                        BracketRepair& repair) {
  MarkSearch(text, tokens, repair).run();
}

}  // namespace sdlc::lang
