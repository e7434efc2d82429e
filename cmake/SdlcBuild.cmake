# Settings of the whole build: language, floating point, warnings, sanitizers, where programs go.

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, RelWithDebInfo or Debug" FORCE)
endif()

find_package(GTest QUIET)
# The CMake package of Debian's OpenImageIO also requires its command-line tools (and Qt); pkg-config does not.
find_package(PkgConfig REQUIRED)
pkg_check_modules(OIIO QUIET IMPORTED_TARGET OpenImageIO>=2.4)
set(can_test OFF)
if(GTest_FOUND AND OIIO_FOUND)
  set(can_test ON)
endif()
option(SDLC_TESTS "Build the tests (needs GoogleTest and OpenImageIO)" ${can_test})
find_package(benchmark QUIET)
option(SDLC_BENCHMARKS "Build the benchmarks of bench/ (needs Google Benchmark)" ${benchmark_FOUND})
option(SDLC_WERROR "Treat warnings as errors" OFF)
option(SDLC_FUZZ "Build the fuzzers of tests/fuzz (needs clang)" OFF)
set(SDLC_SANITIZE "" CACHE STRING "Sanitizers for -fsanitize=, e.g. address,undefined or thread")

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

# The same picture with every compiler and optimisation level: no contraction of products and sums (the
# code calls std::fma explicitly), and no value-changing optimisations.
add_compile_options(-ffp-contract=off -fno-fast-math)
# g++ 12 warns about overlapping copies inside std::string where there are none (GCC bug 105329): -Wno-restrict.
add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
if(SDLC_WERROR)
  add_compile_options(-Werror)
endif()
if(SDLC_SANITIZE)
  add_compile_options(-fsanitize=${SDLC_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=${SDLC_SANITIZE})
endif()
if(SDLC_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
endif()
# The checked standard library reports out-of-range indices where they happen.
add_compile_definitions($<$<CONFIG:Debug>:_GLIBCXX_ASSERTIONS>)

# Without ccache, the first build is what counts: precompiled headers and several sources in one translation unit
# halve it. ccache stores nothing that was compiled with precompiled headers.
find_program(CCACHE ccache)
if(CCACHE AND NOT DEFINED ENV{CCACHE_DISABLE})
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
  set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)
  set(SDLC_BUILDS_ONCE OFF)
else()
  set(SDLC_BUILDS_ONCE ON)
endif()

# The build tree has the shape of an installation, so that the program finds its modules the same way in both.
include(GNUInstallDirs)
# What is installed is built by its own targets; tests are not.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_BINDIR})
# A folder deeper than lib/sdlc: there CPack would take modules for libraries and call ldconfig.
set(SDLC_MODULE_DIR lib/sdlc/modules)
