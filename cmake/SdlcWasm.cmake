# The WebAssembly build: emscripten's flags, and the libraries of header files, which are those of the machine.

find_path(SDLC_LIBCXX_INCLUDE_DIR ranges NO_CMAKE_FIND_ROOT_PATH
  PATHS /usr/lib/llvm-16/include/c++/v1 /usr/lib/llvm-15/include/c++/v1
  DOC "Headers of libc++ 15 or 16 (libc++-16-dev): those of emscripten lack half of C++20")
if(NOT SDLC_LIBCXX_INCLUDE_DIR)
  message(FATAL_ERROR "The headers of libc++ are missing: install libc++-16-dev, or set SDLC_LIBCXX_INCLUDE_DIR")
endif()

# Without the other headers of the machine, which are those of another C library: a folder with links to what is used.
set(links ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${links})
foreach(header fast_float/fast_float.h fmt/format.h hwy/highway.h nlohmann/json.hpp tao/pegtl.hpp toml++/toml.h)
  get_filename_component(folder ${header} DIRECTORY)
  find_path(headers_of_${folder} ${header} NO_CMAKE_FIND_ROOT_PATH PATHS /usr/include REQUIRED)
  file(CREATE_LINK ${headers_of_${folder}}/${folder} ${links}/${folder} SYMBOLIC)
endforeach()
set(TOMLPLUSPLUS_INCLUDE_DIR ${links})

foreach(library fmt::fmt hwy::hwy nlohmann_json::nlohmann_json taocpp::pegtl Threads::Threads)
  add_library(${library} INTERFACE IMPORTED)
endforeach()
set_target_properties(hwy::hwy PROPERTIES
  INTERFACE_INCLUDE_DIRECTORIES "${PROJECT_SOURCE_DIR}/wasm/compat;${links}")

# The order counts: each of the first two stands in front of the next.
add_compile_options(-nostdinc++
  "SHELL:-isystem ${PROJECT_SOURCE_DIR}/wasm/compat" "SHELL:-isystem ${SDLC_LIBCXX_INCLUDE_DIR}"
  "SHELL:-isystem ${links}")
add_compile_definitions(FMT_HEADER_ONLY)
add_compile_options(-msimd128 -fwasm-exceptions)
# Sizes have 32 bits here; Highway names an instruction set that is there anyway.
add_compile_options(-Wno-shorten-64-to-32 -Wno-pragma-clang-attribute)
# For threads; the same objects are linked for one thread too.
add_compile_options(-pthread)
add_link_options(-fwasm-exceptions)
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")

set(CMAKE_POSITION_INDEPENDENT_CODE OFF)
# em++ takes longer to start than a small file to compile.
set(SDLC_BUILDS_ONCE ON)
set(CMAKE_DISABLE_PRECOMPILE_HEADERS ON)

# What asks the system for more than a page has; those of the same names in wasm/system stand in.
set(SDLC_REPLACED_SOURCES lang/eval/stack_segments.cpp lsp/child_process.cpp render/image/codec_module.cpp
  render/parallel/thread_probe.cpp)
list(TRANSFORM SDLC_REPLACED_SOURCES PREPEND ${PROJECT_SOURCE_DIR}/)
