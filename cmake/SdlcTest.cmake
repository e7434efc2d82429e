# sdlc_test(NAME FILES file... LINKS target...)
#
# A GoogleTest program of its own for one folder of tests; ctest runs each of its tests in a process of its
# own. SDLC_SOURCE_DIR is the root of the repository as a string, for tests that read its files.
find_package(GTest REQUIRED)
include(GoogleTest)

function(sdlc_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FILES;LINKS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_FILES)
    message(FATAL_ERROR "sdlc_test(${name}): wants FILES and LINKS, got ${ARGN}")
  endif()

  add_executable(${name} ${arg_FILES})
  target_link_libraries(${name} PRIVATE ${arg_LINKS} GTest::gmock GTest::gtest GTest::gtest_main)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(${name} PRIVATE SDLC_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # Beside bin/, so that test programs find modules the way the real program does, without being among what
  # a user runs.
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/test_bin)
  # Listing the tests when ctest starts, not when the program is linked, keeps a crash at start-up a failed
  # test instead of a failed build.
  # A parameter's value is part of a test's name only through the name its suite gives it: a dump of its bytes
  # would name the test anew in each run.
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST NO_PRETTY_VALUES)
endfunction()
