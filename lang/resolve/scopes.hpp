#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sdlc::lang {

/// The local names that are visible at one place of a file: parameters, loop variables and the lets
/// of blocks. The slot of a name in the frame is the number of names around it.
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

  /// Slots needed by all locals since reset_frame_size().
  std::uint32_t frame_size() const noexcept { return frame_size_; }
  void reset_frame_size() noexcept { frame_size_ = 0; }

  class Block;

 private:
  struct Local {
    std::string_view name;
    std::uint32_t hidden;  ///< the local of the same name further out that by_name_ had, or kNone
  };
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::size_t kLinear = 32;

  void leave(std::size_t size);

  std::vector<Local> locals_;  // by slot
  // The first kLinear locals are searched one by one, which is faster; by_name_ has the others.
  std::unordered_map<std::string_view, std::uint32_t> by_name_;
  std::size_t block_begin_ = 0;  // slot of the innermost block's first local
  std::uint32_t frame_size_ = 0;
};

/// A block: the locals that are declared during its lifetime are forgotten at its end.
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
