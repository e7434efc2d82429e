# sdlc_test(NAME FILES file... LINKS target...)
#
# A GoogleTest program for one folder of tests; ctest runs each of its tests in a separate process. SDLC_SOURCE_DIR is the root of the repository as a string, for tests that read its files.
find_package(GTest REQUIRED)
include(GoogleTest)

# Tests are compiled more often than they run, and what takes time is in the modules: -O1 compiles a quarter faster than
# the -O3 of a release.
set(SDLC_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)

# As for modules, with GoogleTest. A program, because libraries are compiled with -fPIC and programs with -fPIE.
add_executable(sdlc_test_precompiled EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/precompiled.cpp)
target_compile_options(sdlc_test_precompiled PRIVATE ${SDLC_TEST_OPTIONS})
target_link_libraries(sdlc_test_precompiled PRIVATE GTest::gmock GTest::gtest GTest::gtest_main)
target_precompile_headers(sdlc_test_precompiled PRIVATE ${SDLC_PRECOMPILED_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)

function(sdlc_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FILES;LINKS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_FILES)
    message(FATAL_ERROR "sdlc_test(${name}): wants FILES and LINKS, got ${ARGN}")
  endif()

  add_executable(${name} ${arg_FILES})
  target_compile_options(${name} PRIVATE ${SDLC_TEST_OPTIONS})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} GTest::gmock GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_precompile_headers(${name} REUSE_FROM sdlc_test_precompiled)
  target_compile_definitions(${name} PRIVATE SDLC_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # Beside bin/, so that test programs find modules as the real program does, but are not among the programs
  # for users.
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test_bin)
  # List the tests when ctest starts, not when the program is linked: a crash at start-up is then a failed
  # test instead of a failed build.
  # Only names given by the suite become part of a parameterised test's name: a dump of the parameter's bytes
  # would change in each run.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES)
endfunction()
