#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace sdlc::render {

/// Uninitialised memory for tables, aligned for vectors of any width. Large tables get huge pages
/// where the system has them: the first touch of a small page takes about a microsecond, and each
/// small page takes an entry of the TLB. Throws std::bad_alloc.
inline void* allocate_table(std::size_t bytes) {
  constexpr std::size_t kVector = 64, kHugePage = std::size_t{1} << 21;
  const bool is_large = bytes >= 4 * kHugePage;
  const std::size_t alignment = is_large ? kHugePage : kVector;
  if (bytes > PTRDIFF_MAX - kHugePage) throw std::bad_alloc();
  const std::size_t size = (bytes + alignment - 1) / alignment * alignment;
  void* const memory = std::aligned_alloc(alignment, size);
  if (memory == nullptr && bytes > 0) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  if (is_large) ::madvise(memory, size, MADV_HUGEPAGE);  // only advice: errors do not matter
#endif
  return memory;
}

inline void free_table(void* memory) noexcept { std::free(memory); }

}  // namespace sdlc::render
