# sdlc_module(NAME [PUBLIC target...] [PRIVATE target...] [EXCLUDE file...])
#
# The library of the current folder: target sdlc_NAME, known as sdlc::NAME, from every .cpp and .hpp in the
# folder itself except the excluded ones. Includes are written from the root of the repository. A folder
# without .cpp files becomes an interface library. Each call is recorded in the global property SDLC_MODULES;
# a test uses it to check that a folder includes only modules that it declares here.
function(sdlc_module name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "PUBLIC;PRIVATE;EXCLUDE")
  if(arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "sdlc_module(${name}): unknown arguments ${arg_UNPARSED_ARGUMENTS}")
  endif()

  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.cpp)
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/*.hpp)
  list(TRANSFORM arg_EXCLUDE PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  list(REMOVE_ITEM sources ${arg_EXCLUDE})
  set(target sdlc_${name})
  if(sources)
    add_library(${target} STATIC ${sources})
    set(public PUBLIC)
    target_link_libraries(${target} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE})
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
