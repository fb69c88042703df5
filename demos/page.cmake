# SPDX-License-Identifier: MIT
# The page: a folder with the demos and the program oiler as one WebAssembly program, whose first
# argument names the one to run, and with the scenes.
set(OILER_WEB_HASHES "" CACHE FILEPATH "State hashes of native runs, see tests/web; optional")
set(folder ${PROJECT_BINARY_DIR}/page)

# A main function is one of several here.
set(declarations)
set(entries)
set(objects)
foreach(name IN LISTS demos ITEMS oiler)
  set(file ${name}.cpp)
  if(name STREQUAL oiler)
    set(file ${PROJECT_SOURCE_DIR}/engine/oiler/cli/main.cpp)
  endif()
  add_library(page_${name} OBJECT ${file})
  target_compile_definitions(page_${name} PRIVATE main=main_of_${name})
  target_link_libraries(page_${name} PRIVATE oiler::cli oiler_warnings)
  list(APPEND objects page_${name})
  string(APPEND declarations "int main_of_${name}(int argc, char** argv);\n")
  list(APPEND entries "{\"${name}\", main_of_${name}}")
endforeach()
list(JOIN entries ", " entries)
configure_file(page.cpp.in page.cpp @ONLY)
add_executable(page ${CMAKE_CURRENT_BINARY_DIR}/page.cpp)
target_link_libraries(page PRIVATE ${objects} oiler::cli)
target_link_options(page PRIVATE -Oz
  -sMIN_WEBGL_VERSION=2 -sMAX_WEBGL_VERSION=2 -sGL_ENABLE_GET_PROC_ADDRESS=1
  -sALLOW_MEMORY_GROWTH=1 -sSTACK_SIZE=1MB -sENVIRONMENT=web,worker
  -sMODULARIZE=1 -sEXPORT_NAME=createOiler -sEXPORTED_RUNTIME_METHODS=FS -sFORCE_FILESYSTEM=1
  "SHELL:--embed-file ${PROJECT_SOURCE_DIR}/assets/scenes@/scenes")
file(GLOB scenes CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/assets/scenes/*)
set_target_properties(page PROPERTIES OUTPUT_NAME oiler LINK_DEPENDS "${scenes}")

# list.js: what the page offers, from the places where it is written.
file(STRINGS demos.txt lines ENCODING UTF-8)
set(list "const oilerList = {\n  demos: [\n")
foreach(line IN LISTS lines)
  string(REGEX REPLACE "^([^:]+): (.*)$" "    {name: \"\\1\", text: \"\\2\"},\n" line "${line}")
  string(APPEND list "${line}")
endforeach()
string(APPEND list "  ],\n  scenes: [\n")
file(GLOB scenes RELATIVE ${PROJECT_SOURCE_DIR}/assets/scenes ${PROJECT_SOURCE_DIR}/assets/scenes/*.toml)
foreach(scene IN LISTS scenes)
  file(STRINGS ${PROJECT_SOURCE_DIR}/assets/scenes/${scene} title REGEX "^title = " ENCODING UTF-8)
  string(REGEX REPLACE "^title = " "" title "${title}")
  if(NOT title)
    set(title "\"${scene}\"")
  endif()
  string(APPEND list "    {file: \"${scene}\", title: ${title}},\n")
endforeach()
set(hashes "{}")
if(OILER_WEB_HASHES)
  file(READ ${OILER_WEB_HASHES} hashes)
endif()
string(APPEND list "  ],\n  hashes: ${hashes}\n};\n")
file(CONFIGURE OUTPUT ${folder}/list.js CONTENT "${list}" @ONLY)

file(GLOB files CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/assets/web/*
                                  ${PROJECT_SOURCE_DIR}/assets/pictures/menu/*.png)
add_custom_command(
  OUTPUT ${folder}/program.js
  DEPENDS page ${files} page_folder.sh
  COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/page_folder.sh $<TARGET_FILE_DIR:page>/oiler ${folder}
          ${PROJECT_SOURCE_DIR}/assets
  VERBATIM)
add_custom_target(page_folder ALL DEPENDS ${folder}/program.js)
