#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sdlc::lang {

/// The local names (parameters, loop variables, lets of blocks) that are visible at one place of a
/// file. The slot of a local in the frame is the number of visible locals before it.
class Scopes {
 public:
  /// The slot of the innermost local of this name.
  std::optional<std::uint32_t> find(std::string_view name) const;
  /// Declares a name in the innermost block; returns its slot.
  std::uint32_t declare(std::string_view name);
  /// Whether the innermost block declares the slot itself.
  bool is_innermost(std::uint32_t slot) const noexcept { return slot >= block_begin_; }

  std::size_t size() const noexcept { return locals_.size(); }
  std::string_view name_of(std::uint32_t slot) const noexcept { return locals_[slot].name; }

  /// The number of slots for all locals since reset_frame_size().
  std::uint32_t frame_size() const noexcept { return frame_size_; }
  void reset_frame_size() noexcept { frame_size_ = 0; }

  class Block;

 private:
  struct Local {
    std::string_view name;
    std::uint32_t hidden;  ///< slot of the outer local with this name in by_name_, or kNone
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::size_t kMaxLinear = 32;

  void leave(std::size_t size);

  std::vector<Local> locals_;  // by slot
  // Linear search is faster for the first kMaxLinear locals; by_name_ has the others.
  std::unordered_map<std::string_view, std::uint32_t> by_name_;
  std::size_t block_begin_ = 0;  // slot of the innermost block's first local
  std::uint32_t frame_size_ = 0;
};

/// A block: removes the locals that were declared during its lifetime.
class Scopes::Block {
 public:
  explicit Block(Scopes& scopes)
      : scopes_(scopes),
        size_(scopes.size()),
        outer_begin_(std::exchange(scopes.block_begin_, size_)) {}
  ~Block() {
    scopes_.leave(size_);
    scopes_.block_begin_ = outer_begin_;
  }
  Block(const Block&) = delete;
  Block& operator=(const Block&) = delete;

 private:
  Scopes& scopes_;
  std::size_t size_, outer_begin_;
};

}  // namespace sdlc::lang
