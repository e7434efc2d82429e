# sdlc_embed_pages(TARGET VARIABLE FOLDER)
#
# Compiles the Markdown pages of a folder, except its README.md, into the target as
#   extern const std::span<const sdlc::lang::Page> VARIABLE
# in the order of their names. The next build embeds edited and new pages.
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

if(NOT CMAKE_SCRIPT_MODE_FILE STREQUAL CMAKE_CURRENT_LIST_FILE)
  return()
endif()

# Arrays of characters, not string literals: compilers limit the length of those.
set(arrays "")
set(rows "")
foreach(page IN LISTS PAGES)
  get_filename_component(name ${page} NAME_WE)
  file(READ ${page} bytes HEX)
  string(REGEX REPLACE "(..)" "'\\\\x\\1'," bytes "${bytes}")
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
