# SPDX-License-Identifier: MIT
# oiler_page(TARGET LIST NAME FILE [NAME FILE]...): a page in the folder `page` of the build, with the
# games of these names, each of which has its main function in FILE, and with the program oiler. They
# are one WebAssembly program, so that it is loaded and compiled once; its first argument names the one
# to run. LIST is the text of list.js: what the page offers.
function(oiler_page target list)
  set(cmake ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  cmake_path(GET cmake PARENT_PATH engine)
  cmake_path(GET engine PARENT_PATH source)
  set(assets ${source}/assets)
  list(APPEND ARGN oiler ${engine}/oiler/cli/main.cpp)
  set(folder ${CMAKE_BINARY_DIR}/page)
  set(declarations)
  set(entries)
  set(objects)
  while(ARGN)
    list(POP_FRONT ARGN name file)
    string(MAKE_C_IDENTIFIER main_of_${name} main)
    add_library(${target}_${name} OBJECT ${file})
    target_compile_definitions(${target}_${name} PRIVATE main=${main})
    target_link_libraries(${target}_${name} PRIVATE oiler::cli)
    list(APPEND objects ${target}_${name})
    string(APPEND declarations "int ${main}(int argc, char** argv);\n")
    list(APPEND entries "{\"${name}\", ${main}}")
  endwhile()
  list(JOIN entries ", " entries)
  configure_file(${cmake}/page.cpp.in ${target}.cpp @ONLY)
  file(CONFIGURE OUTPUT ${folder}/list.js CONTENT "${list}" @ONLY)

  add_executable(${target} ${CMAKE_CURRENT_BINARY_DIR}/${target}.cpp)
  target_link_libraries(${target} PRIVATE ${objects} oiler::cli)
  set_target_properties(${target} PROPERTIES OUTPUT_NAME oiler)
  target_link_options(${target} PRIVATE -Oz
    -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2 -sGL_ENABLE_GET_PROC_ADDRESS=1
    -sALLOW_MEMORY_GROWTH=1 -sSTACK_SIZE=1MB -sENVIRONMENT=web,worker
    -sMODULARIZE=1 -sEXPORT_NAME=createOiler -sEXPORTED_RUNTIME_METHODS=FS -sFORCE_FILESYSTEM=1)
  file(GLOB files CONFIGURE_DEPENDS ${assets}/web/* ${assets}/pictures/menu/*.png)
  add_custom_command(
    OUTPUT ${folder}/program.js
    DEPENDS ${target} ${files} ${cmake}/page_folder.sh
    COMMAND sh ${cmake}/page_folder.sh $<TARGET_FILE_DIR:${target}>/oiler ${folder} ${assets}
    VERBATIM)
  add_custom_target(${target}_folder ALL DEPENDS ${folder}/program.js)
endfunction()
