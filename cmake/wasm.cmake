# The toolchain of Debian's emscripten, with the headers of a newer libc++.
find_path(EMSCRIPTEN_MODULES Platform/Emscripten.cmake
  PATHS /usr/share/emscripten/cmake/Modules $ENV{EMSCRIPTEN}/cmake/Modules REQUIRED NO_DEFAULT_PATH)
include(${EMSCRIPTEN_MODULES}/Platform/Emscripten.cmake)
# No library of this machine.
set(ENV{PKG_CONFIG_LIBDIR} "")
