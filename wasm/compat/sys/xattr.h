// Files in memory have no extended attributes.
#pragma once

#include <cerrno>
#include <cstddef>

#include <sys/types.h>

#define XATTR_LIST_MAX 1
#define XATTR_SIZE_MAX 1

inline ssize_t listxattr(const char* /*path*/, char* /*names*/, std::size_t /*size*/) { return 0; }
inline ssize_t getxattr(const char* /*path*/, const char* /*name*/, void* /*value*/,
                        std::size_t /*size*/) {
  errno = ENOTSUP;
  return -1;
}
inline int fsetxattr(int /*fd*/, const char* /*name*/, const void* /*value*/, std::size_t /*size*/,
                     int /*flags*/) {
  errno = ENOTSUP;
  return -1;
}
inline int fremovexattr(int /*fd*/, const char* /*name*/) {
  errno = ENOTSUP;
  return -1;
}
