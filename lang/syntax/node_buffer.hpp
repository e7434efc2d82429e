#pragma once

#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>

namespace sdlc::lang {

/// A growing array of trivial elements. Unlike std::vector it grows by realloc, which moves no byte
/// of a large array (so that the peak is not three halves of the need), and its push is small
/// enough to be inlined: the parser was 1.4 times as fast with it.
template <typename T>
class NodeBuffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  NodeBuffer() = default;
  explicit NodeBuffer(std::size_t capacity) { grow(capacity); }

  std::size_t size() const noexcept { return size_; }
  T* data() noexcept { return data_.get(); }
  const T* data() const noexcept { return data_.get(); }
  T& operator[](std::size_t index) noexcept { return data_[index]; }
  const T& operator[](std::size_t index) const noexcept { return data_[index]; }
  std::span<T> span() noexcept { return {data_.get(), size_}; }
  std::span<const T> span() const noexcept { return {data_.get(), size_}; }

  [[gnu::always_inline]] void push(const T& value) {
    if (size_ == capacity_) [[unlikely]]
      grow(capacity_ * 2 + 16);
    data_[size_++] = value;
  }
  void insert(std::size_t index, const T& value) {
    push(value);
    std::memmove(&data_[index + 1], &data_[index], (size_ - 1 - index) * sizeof(T));
    data_[index] = value;
  }
  /// Precondition: `size` is at most size().
  void truncate(std::size_t size) noexcept { size_ = size; }

 private:
  struct Free {
    void operator()(T* data) const noexcept { std::free(data); }
  };

  [[gnu::noinline]] void grow(std::size_t capacity) {
    void* data = std::realloc(data_.get(), capacity * sizeof(T));
    if (data == nullptr) throw std::bad_alloc();
    static_cast<void>(data_.release());
    data_.reset(static_cast<T*>(data));
    capacity_ = capacity;
  }

  std::unique_ptr<T[], Free> data_;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace sdlc::lang
