# SPDX-License-Identifier: MIT
# Generated sources of oiler_render: the GL loader from glad, and the embedded shaders and font. An
# installed program therefore needs no files.
find_program(OILER_GLAD_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH REQUIRED)
find_file(OILER_FONT DejaVuSans.ttf PATHS /usr/share/fonts/truetype/dejavu)
if(NOT OILER_FONT)
  message(FATAL_ERROR "DejaVuSans.ttf not found: install the Debian package fonts-dejavu-core")
endif()
find_path(OILER_STB_INCLUDE stb_truetype.h PATH_SUFFIXES stb)
if(NOT OILER_STB_INCLUDE)
  message(FATAL_ERROR "stb_truetype.h not found: install the Debian package libstb-dev")
endif()

set(OILER_GLAD ${CMAKE_CURRENT_BINARY_DIR}/glad)
add_custom_command(
  OUTPUT ${OILER_GLAD}/src/gl.c ${OILER_GLAD}/include/glad/gl.h
  COMMAND ${OILER_GLAD_PYTHON} -m glad --quiet --reproducible --merge --api gl:core=3.3,gles2=3.0
          --extensions GL_KHR_debug --out-path ${OILER_GLAD} c --mx
  COMMENT "Generating the GL loader (Debian package python3-glad)"
  VERBATIM)
set_source_files_properties(${OILER_GLAD}/src/gl.c PROPERTIES COMPILE_OPTIONS -w)

set(oiler_assets font ${OILER_FONT})
foreach(asset disc_frag disc_vert line_frag line_vert overlay_frag overlay_vert splats_frag splats_vert
              sprite_frag sprite_vert text_frag text_vert)
  string(REPLACE "_" "." file ${asset})
  list(APPEND oiler_assets ${asset} ${PROJECT_SOURCE_DIR}/assets/shaders/${file})
endforeach()
set(target oiler_render)
set(embed ${oiler_assets})
include(${OILER_ENGINE}/cmake/embed.cmake)

target_sources(oiler_render PRIVATE ${OILER_GLAD}/src/gl.c ${OILER_GLAD}/include/glad/gl.h)
target_include_directories(oiler_render SYSTEM PRIVATE ${OILER_GLAD}/include ${OILER_STB_INCLUDE})
