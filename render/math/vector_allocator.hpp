#pragma once

#include <cstddef>
#include <new>
#include <utility>

#include "render/math/table_memory.hpp"

namespace sdlc::render {

/// An allocator aligned for vectors of any width. Elements are default-initialised, so that the
/// threads that fill a table touch its memory first.
template <typename T>
struct VectorAllocator {
  using value_type = T;

  VectorAllocator() = default;
  template <typename U>
  explicit VectorAllocator(const VectorAllocator<U>& /*other*/) noexcept {}

  T* allocate(std::size_t count) { return static_cast<T*>(allocate_table(count * sizeof(T))); }
  template <typename U>
  void construct(U* place) noexcept {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Values>
  void construct(U* place, Values&&... values) noexcept {
    ::new (static_cast<void*>(place)) U(std::forward<Values>(values)...);
  }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { free_table(memory); }
  friend bool operator==(VectorAllocator, VectorAllocator) noexcept { return true; }
};

}  // namespace sdlc::render
