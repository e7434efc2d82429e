# sdlc_embed_pages(TARGET VARIABLE FOLDER)
#
# Compiles the Markdown pages of a folder, except its README.md, into the target as
#   extern const std::span<const sdlc::lang::Page> VARIABLE
# in the order of their names. The next build embeds edited and new pages.
#
# sdlc_embed_texts(TARGET NAMESPACE FILE...)
#
# Compiles files of the current folder into the target as
#   extern const std::string_view kPageHtml   (of page.html)
#
# As a script (cmake -DOUTPUT=… -DVARIABLE=… -DPAGES=… -P SdlcEmbed.cmake) this file writes the source.
function(sdlc_embed_pages target variable folder)
  file(GLOB pages CONFIGURE_DEPENDS ${folder}/*.md)
  list(FILTER pages EXCLUDE REGEX "/README\\.md$")
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${variable}.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/SdlcEmbed.cmake)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DVARIABLE=${variable} "-DPAGES=${pages}" -P ${script}
    DEPENDS ${pages} ${script} COMMENT "Embedding the pages of ${folder}" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

function(sdlc_embed_texts target namespace)
  list(TRANSFORM ARGN PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE files)
  set(output ${CMAKE_CURRENT_BINARY_DIR}/${target}_texts.cpp)
  set(script ${PROJECT_SOURCE_DIR}/cmake/SdlcEmbed.cmake)
  add_custom_command(OUTPUT ${output}
    COMMAND ${CMAKE_COMMAND} -DOUTPUT=${output} -DNAMESPACE=${namespace} "-DTEXTS=${files}" -P ${script}
    DEPENDS ${files} ${script} COMMENT "Embedding texts into ${target}" VERBATIM)
  target_sources(${target} PRIVATE ${output})
endfunction()

if(NOT CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  return()
endif()

# Arrays of characters, not string literals: compilers limit the length of those.
function(bytes_of file result)
  file(READ ${file} bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
  set(${result} "${bytes}" PARENT_SCOPE)
endfunction()

if(TEXTS)
  set(arrays "")
  set(views "")
  foreach(text IN LISTS TEXTS)
    get_filename_component(stem ${text} NAME_WE)
    get_filename_component(extension ${text} LAST_EXT)
    set(name k)
    foreach(part ${stem} ${extension})
      string(REPLACE "." "" part ${part})
      string(SUBSTRING ${part} 0 1 first)
      string(SUBSTRING ${part} 1 -1 rest)
      string(TOUPPER ${first} first)
      string(APPEND name ${first}${rest})
    endforeach()
    bytes_of(${text} bytes)
    string(APPEND arrays "constexpr char ${name}Bytes[] = {${bytes}};\n")
    string(APPEND views "extern const std::string_view ${name};
const std::string_view ${name}(${name}Bytes, sizeof(${name}Bytes));\n")
  endforeach()
  file(WRITE ${OUTPUT} "#include <string_view>

namespace ${NAMESPACE} {
namespace {

${arrays}
}  // namespace

${views}
}  // namespace ${NAMESPACE}
")
  return()
endif()

set(arrays "")
set(rows "")
foreach(page IN LISTS PAGES)
  get_filename_component(name ${page} NAME_WE)
  bytes_of(${page} bytes)
  string(APPEND arrays "constexpr char k${name}[] = {${bytes}};\n")
  string(APPEND rows "    {\"${name}\", {k${name}, sizeof(k${name})}},\n")
endforeach()
file(WRITE ${OUTPUT} "#include \"lang/explain/pages.hpp\"

namespace sdlc::lang {
namespace {

${arrays}
constexpr Page kRows[] = {
${rows}};

}  // namespace

const std::span<const Page> ${VARIABLE}(kRows);

}  // namespace sdlc::lang
")
