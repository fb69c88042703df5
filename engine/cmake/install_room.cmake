# SPDX-License-Identifier: MIT
# Installs the room of room.cmake as a component of the package: headers, library, and the target in
# oiler-ROOM.cmake. Global properties pass it to package.cmake:
#   OILER_INSTALLED       all installed rooms, lowest first
#   OILER_ROOM_rooms      rooms that the room links
#   OILER_ROOM_packages   packages that its users must find
#   OILER_ROOM_modules    pkg-config modules that its users must find
#   OILER_ROOM_libraries  other libraries that it links
set_property(GLOBAL APPEND PROPERTY OILER_INSTALLED ${room})
set_property(GLOBAL PROPERTY OILER_${room}_rooms ${rooms})
foreach(link IN LISTS links private_links)
  if(link MATCHES "^PkgConfig::OILER_(.+)$")
    set_property(GLOBAL APPEND PROPERTY OILER_${room}_modules ${CMAKE_MATCH_1})
  elseif(link MATCHES "^([A-Za-z0-9_]+)::")
    set_property(GLOBAL APPEND PROPERTY OILER_${room}_packages ${CMAKE_MATCH_1})
  elseif(NOT link MATCHES "^\\$<BUILD_INTERFACE:")
    set_property(GLOBAL APPEND PROPERTY OILER_${room}_libraries ${link})
  endif()
endforeach()

install(TARGETS oiler_${room} EXPORT oiler-${room})
set(not_installed)
foreach(header IN LISTS private_headers)
  list(APPEND not_installed PATTERN ${header} EXCLUDE)
endforeach()
install(DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}/
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/oiler/${room}
        FILES_MATCHING ${not_installed} PATTERN "*.hpp")
install(EXPORT oiler-${room} NAMESPACE oiler:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/oiler)
