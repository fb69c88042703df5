# SPDX-License-Identifier: MIT
# Defines the library oiler::ROOM for the room whose CMakeLists.txt includes this file; ROOM is the
# name of the folder. Variables:
#   sources        files of the room, relative to the folder; empty for a room of headers only
#   rooms          rooms that its headers include; they are added first
#   links          libraries that users of the room link too
#   private_links  libraries that only its own files include; header-only ones in
#                  $<BUILD_INTERFACE:>, because an installed room does not need them
#   private_headers  headers that only its own files include: they are not installed; optional
#   hot            files that run for each body or pixel; optional
# Files that are not hot are compiled at -O1: sooner by a fifth, while frames cost the same. For a page,
# which is loaded, they are compiled for size.
# A link PkgConfig::OILER_NAME is the pkg-config module NAME; the installed package looks for it.
cmake_path(GET CMAKE_CURRENT_SOURCE_DIR FILENAME room)
foreach(below IN LISTS rooms)
  if(NOT TARGET oiler_${below})
    block()
      unset(private_headers)
      unset(hot)
      add_subdirectory(${OILER_ENGINE}/oiler/${below} ${OILER_ENGINE_BUILD}/${below})
    endblock()
  endif()
endforeach()
list(TRANSFORM rooms PREPEND oiler:: OUTPUT_VARIABLE room_links)
if(sources)
  add_library(oiler_${room} STATIC ${sources})
  target_link_libraries(oiler_${room} PUBLIC oiler::options ${room_links} ${links}
                                      PRIVATE $<BUILD_INTERFACE:oiler_warnings> ${private_links})
  set_target_properties(oiler_${room} PROPERTIES UNITY_BUILD ${OILER_UNITY} UNITY_BUILD_BATCH_SIZE 8)
  target_compile_options(oiler_${room} PRIVATE $<$<NOT:$<CONFIG:Debug>>:$<IF:$<BOOL:${EMSCRIPTEN}>,-Os,-O1>>)
  if(hot)
    # Without errno, a square root is one instruction.
    set_source_files_properties(${hot} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON
      COMPILE_OPTIONS "$<$<NOT:$<CONFIG:Debug>>:$<IF:$<BOOL:${EMSCRIPTEN}>,-Os,-O2>>;-fno-math-errno;-fno-trapping-math")
  endif()
  if(NOT room STREQUAL sim)
    target_link_libraries(oiler_${room} PRIVATE $<BUILD_INTERFACE:oiler_hardening>)
  endif()
else()
  add_library(oiler_${room} INTERFACE)
  target_link_libraries(oiler_${room} INTERFACE oiler::options ${room_links} ${links})
endif()
add_library(oiler::${room} ALIAS oiler_${room})
set_target_properties(oiler_${room} PROPERTIES EXPORT_NAME ${room})
if(PROJECT_IS_TOP_LEVEL AND NOT room STREQUAL cli)
  include(${OILER_ENGINE}/cmake/install_room.cmake)
endif()
