#pragma once

#include <cstddef>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/eval/computed.hpp"

namespace sdlc::lang {

/// What names of values mean at one moment: the top level's, and those of the blocks and calls
/// around.
class Scopes {
 public:
  void declare_at_top(std::string_view name, Computed value) {
    top_.insert_or_assign(name, std::move(value));
  }
  void declare(std::string_view name, Computed value) {
    locals_.push_back({name, std::move(value)});
  }

  /// The innermost value of the name, or null.
  const Computed* find(std::string_view name) const {
    for (std::size_t i = locals_.size(); i > frame_; --i) {
      if (locals_[i - 1].name == name) return &locals_[i - 1].value;
    }
    const auto found = top_.find(name);
    return found == top_.end() ? nullptr : &found->second;
  }

  /// Every name that find() would find, for suggestions.
  std::vector<std::string_view> names() const {
    std::vector<std::string_view> names;
    for (std::size_t i = frame_; i < locals_.size(); ++i) names.push_back(locals_[i].name);
    for (const auto& [name, value] : top_) names.push_back(name);
    return names;
  }

 private:
  friend class BlockScope;
  friend class CallScope;

  struct Local {
    std::string_view name;
    Computed value;
  };

  std::unordered_map<std::string_view, Computed> top_;
  std::vector<Local> locals_;
  std::size_t frame_ = 0;  // locals before it belong to callers and are not seen
};

/// Forgets at its end what was declared while it lived.
class BlockScope {
 public:
  explicit BlockScope(Scopes& scopes) : scopes_(scopes), size_(scopes.locals_.size()) {}
  ~BlockScope() { scopes_.locals_.resize(size_); }
  BlockScope(const BlockScope&) = delete;
  BlockScope& operator=(const BlockScope&) = delete;

 private:
  Scopes& scopes_;
  std::size_t size_;
};

/// The names of a function's call: a body sees its parameters and the top level, not its caller's
/// names.
class CallScope {
 public:
  explicit CallScope(Scopes& scopes) : scopes_(scopes), block_(scopes), frame_(scopes.frame_) {
    scopes_.frame_ = scopes_.locals_.size();
  }
  ~CallScope() { scopes_.frame_ = frame_; }
  CallScope(const CallScope&) = delete;
  CallScope& operator=(const CallScope&) = delete;

 private:
  Scopes& scopes_;
  BlockScope block_;
  std::size_t frame_;
};

}  // namespace sdlc::lang
