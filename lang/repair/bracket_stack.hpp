#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "lang/repair/brackets.hpp"
#include "lang/text/brackets.hpp"

namespace sdlc::lang {

/// The brackets that are open during a scan, and the faults found so far: what both formats share.
class BracketStack {
 protected:
  explicit BracketStack(const TokenList& tokens) : tokens_(tokens) {}

  struct Frame {
    std::uint32_t opener = 0;      ///< a token; of an added bracket the one before it
    char bracket = '\0';           ///< '\0': outside of all brackets
    std::size_t fault = kNoFault;  ///< that reports the bracket as missing
  };
  static constexpr std::size_t kNoFault = static_cast<std::size_t>(-1);
  static constexpr std::uint32_t kDropped = BracketFault::kNone;

  Frame top() const { return open_.empty() ? Frame{} : open_.back(); }
  Frame outer() const { return open_.size() < 2 ? Frame{} : open_[open_.size() - 2]; }
  bool is_in_parenthesis() const { return top().bracket == '(' || top().bracket == '['; }
  const RepairToken& opener() const { return tokens_[top().opener]; }
  /// Whether the bracket is the last of its line.
  bool ends_line(const Frame& frame) const { return tokens_[frame.opener + 1].is_first; }

  void open(std::uint32_t token) { open_.push_back({token, tokens_[token].bracket}); }

  void close(std::uint32_t token) {
    const Frame frame = top();
    if (frame.fault != kNoFault) faults_[frame.fault].partner = token;
    open_.pop_back();
  }

  void open_missing(std::uint32_t token, char bracket) {
    open_.push_back({token - 1, bracket, faults_.size()});
    add(BracketFault::MissingOpen, bracket, token);
  }

  /// Closes the innermost bracket, which the text does not, before the token. A comma before the
  /// token separates what follows: the bracket belongs before it.
  void close_missing(std::uint32_t token) {
    const Frame frame = top();
    const RepairToken &before = tokens_[token - 1], &opener = tokens_[frame.opener];
    const bool is_after_comma = token > frame.opener + 1 && token < tokens_.size() &&
                                before.kind == TokenClass::Comma &&
                                (before.line == opener.line || before.is_first);
    if (is_doubled(token)) {
      open_.pop_back();
      return add(BracketFault::Surplus, frame.bracket, frame.opener);
    }
    const bool is_added = frame.fault != kNoFault;
    open_.pop_back();
    if (is_added) {  // neither bracket is there: there is no pair
      faults_[frame.fault].token = kDropped;
      return;
    }
    add(BracketFault::MissingClose, closing_bracket(frame.bracket),
        is_after_comma ? token - 1 : token, frame.opener);
  }

  /// Whether all that the innermost parenthesis or list holds is another, as in `((0, 1, 0)`.
  bool is_doubled(std::uint32_t token) const {
    const Frame frame = top();
    const std::uint32_t second = frame.opener + 1;
    if (frame.bracket == '{' || frame.fault != kNoFault || !tokens_.is_joined(second) ||
        !tokens_.is_bracket(second, frame.bracket)) {
      return false;
    }
    const std::size_t close = tokens_.partner(second);
    return close + 1 == token || (close + 2 == token && tokens_.is(close + 1, TokenClass::Comma));
  }

  void add(BracketFault::Kind kind, char bracket, std::uint32_t token,
           std::uint32_t partner = BracketFault::kNone) {
    faults_.push_back({kind, bracket, token, partner});
  }

  std::vector<BracketFault> finish() {
    std::erase_if(faults_, [](const BracketFault& fault) { return fault.token == kDropped; });
    std::ranges::stable_sort(faults_, {}, &BracketFault::token);
    return std::move(faults_);
  }

  const TokenList& tokens_;
  std::vector<Frame> open_;
  std::vector<BracketFault> faults_;
};

}  // namespace sdlc::lang
