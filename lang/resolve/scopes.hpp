#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sdlc::lang {

/// The local names (parameters, loop variables, lets) that are visible at one place of a file. A
/// local has a slot in the frame of its statement, fn or def. Frames are nested as definitions are:
/// a definition in a block sees the locals of the frames around its own.
class Scopes {
 public:
  struct Local {
    std::string_view name;
    std::uint32_t frame = 0;  ///< the number of frames around its own
    std::uint32_t slot = 0;   ///< in its frame
    std::uint32_t hidden;     ///< index of the outer local with this name in by_name_, or kNone
  };

  /// The index of the innermost local of this name.
  std::optional<std::uint32_t> find(std::string_view name) const;
  /// Declares a name in the innermost block; returns its index.
  std::uint32_t declare(std::string_view name);
  /// Whether the innermost block declares the local itself.
  bool is_innermost(std::uint32_t index) const noexcept { return index >= block_begin_; }

  std::size_t size() const noexcept { return locals_.size(); }
  const Local& operator[](std::uint32_t index) const noexcept { return locals_[index]; }
  /// The number of frames around the current one.
  std::uint32_t frame() const noexcept { return frame_; }

  /// The number of slots of the current frame since reset_frame_size().
  std::uint32_t frame_size() const noexcept { return frame_size_; }
  void reset_frame_size() noexcept { frame_size_ = 0; }
  /// Locals that are declared from now on have none of the first `slots` slots.
  void reserve(std::uint32_t slots) noexcept {
    reserved_ = slots;
    frame_size_ = std::max(frame_size_, slots);
  }

  class Block;
  class Frame;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  static constexpr std::size_t kMaxLinear = 32;

  void leave(std::size_t size);

  std::vector<Local> locals_;
  // Linear search is faster for the first kMaxLinear locals; by_name_ has the others.
  std::unordered_map<std::string_view, std::uint32_t> by_name_;
  std::size_t block_begin_ = 0;  // index of the innermost block's first local
  std::size_t frame_begin_ = 0;  // index of the current frame's first local
  std::uint32_t frame_ = 0;
  std::uint32_t frame_size_ = 0;
  std::uint32_t reserved_ = 0;
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

/// A frame inside the current one. Blocks of it must not outlive it.
class Scopes::Frame {
 public:
  explicit Frame(Scopes& scopes)
      : scopes_(scopes),
        begin_(std::exchange(scopes.frame_begin_, scopes.size())),
        size_(std::exchange(scopes.frame_size_, 0)),
        reserved_(std::exchange(scopes.reserved_, 0)) {
    ++scopes_.frame_;
  }
  ~Frame() {
    --scopes_.frame_;
    scopes_.frame_begin_ = begin_;
    scopes_.frame_size_ = size_;
    scopes_.reserved_ = reserved_;
  }
  Frame(const Frame&) = delete;
  Frame& operator=(const Frame&) = delete;

 private:
  Scopes& scopes_;
  std::size_t begin_;
  std::uint32_t size_, reserved_;
};

}  // namespace sdlc::lang
