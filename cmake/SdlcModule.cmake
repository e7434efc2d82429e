# Parsing headers of the standard library is up to half of the time of a small file. All modules share these,
# parsed once; sources still include what they use.
set(SDLC_PRECOMPILED_HEADERS
  <algorithm> <array> <charconv> <chrono> <cmath> <deque> <filesystem> <functional> <map> <memory> <optional> <ostream>
  <set> <span> <stop_token> <string> <string_view> <tuple> <unordered_map> <unordered_set> <utility> <variant> <vector>)
file(CONFIGURE OUTPUT ${PROJECT_BINARY_DIR}/precompiled.cpp CONTENT "")
add_library(sdlc_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_precompile_headers(sdlc_precompiled PRIVATE ${SDLC_PRECOMPILED_HEADERS})

# sdlc_module(NAME [PUBLIC target...] [PRIVATE target...] [EXCLUDE file...])
#
# The library of the current folder: target sdlc_NAME, known as sdlc::NAME, from every .cpp and .hpp in the
# folder itself except the excluded ones, and those of SDLC_REPLACED_SOURCES. Includes are written from the root of
# the repository. A folder without .cpp files becomes an interface library. Each call is recorded in the global
# property SDLC_MODULES; a test uses it to check that a folder includes only modules that it declares here.
function(sdlc_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE;EXCLUDE")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "sdlc_module(${name}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()

  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  list(TRANSFORM arg_EXCLUDE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${arg_EXCLUDE} ${SDLC_REPLACED_SOURCES})
  set(target sdlc_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(public PUBLIC)
    target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
    target_precompile_headers(${target} REUSE_FROM sdlc_precompiled)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${SDLC_BUILDS_ONCE} UNITY_BUILD_BATCH_SIZE 16)
  else()
    add_library(${target} INTERFACE)
    set(public INTERFACE)
    target_link_libraries(${target} INTERFACE ${arg_PUBLIC})
  endif()
  add_library(sdlc::${name} ALIAS ${target})
  target_include_directories(${target} ${public} ${PROJECT_SOURCE_DIR})
  target_sources(${target} ${public} FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${headers})

  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  list(JOIN arg_PUBLIC " " uses_public)
  list(JOIN arg_PRIVATE " " uses_private)
  set_property(GLOBAL APPEND PROPERTY SDLC_MODULES
    "sdlc::${name} ${folder} : ${uses_public} : ${uses_private}")
endfunction()
