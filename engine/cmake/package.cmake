# SPDX-License-Identifier: MIT
# Installs the files that find_package(oiler) and pkg-config read, and sets up cpack. It is included
# after all rooms are defined.
include(CMakePackageConfigHelpers)

get_property(installed GLOBAL PROPERTY OILER_INSTALLED)
set(room_facts)
foreach(room IN LISTS installed)
  foreach(fact rooms packages modules)
    get_property(values GLOBAL PROPERTY OILER_${room}_${fact})
    string(APPEND room_facts "set(oiler_${room}_${fact} ${values})\n")
  endforeach()
endforeach()
string(REPLACE ";" " " room_facts "${room_facts}")
list(JOIN installed " " room_names)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/oiler)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/oiler-config.cmake.in
                              ${PROJECT_BINARY_DIR}/oiler-config.cmake
                              INSTALL_DESTINATION ${package_folder}
                              NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/oiler-config-version.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/oiler-config.cmake
              ${PROJECT_BINARY_DIR}/oiler-config-version.cmake
        DESTINATION ${package_folder})
install(TARGETS oiler_options EXPORT oiler-options)
install(EXPORT oiler-options NAMESPACE oiler:: DESTINATION ${package_folder})

# NAME.pc links a room and the rooms below it. Its folders are relative to NAME.pc, also if
# CMAKE_INSTALL_LIBDIR is absolute, so that an installed prefix can be moved.
foreach(folder LIBDIR INCLUDEDIR)
  cmake_path(ABSOLUTE_PATH CMAKE_INSTALL_${folder} BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX} NORMALIZE
             OUTPUT_VARIABLE ${folder})
endforeach()
cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${LIBDIR}/pkgconfig
           OUTPUT_VARIABLE to_prefix)
cmake_path(RELATIVE_PATH INCLUDEDIR BASE_DIRECTORY ${LIBDIR}/pkgconfig OUTPUT_VARIABLE to_include)

set(uses_app "a game")
set(uses_world "a program that only simulates")
set(name_app oiler)
set(name_world oiler-world)
foreach(top app world)
  if(NOT top IN_LIST installed)
    continue()
  endif()
  set(linked ${top})
  set(libraries)
  set(modules)
  set(others)
  set(highest_first ${installed})
  list(REVERSE highest_first)
  foreach(room IN LISTS highest_first)
    if(NOT room IN_LIST linked)
      continue()
    endif()
    foreach(fact rooms packages modules libraries)
      get_property(room_${fact} GLOBAL PROPERTY OILER_${room}_${fact})
    endforeach()
    list(APPEND linked ${room_rooms})
    get_target_property(type oiler_${room} TYPE)
    if(type STREQUAL STATIC_LIBRARY)
      list(APPEND libraries -loiler_${room})
    endif()
    # Package names are equal for CMake and pkg-config, except Threads, which is an option.
    list(APPEND modules ${room_modules} ${room_packages})
    list(TRANSFORM room_libraries PREPEND -l)
    list(APPEND others ${room_libraries})
  endforeach()
  if(Threads IN_LIST modules)
    list(REMOVE_ITEM modules Threads)
    list(APPEND others -pthread)
  endif()
  list(REMOVE_DUPLICATES modules)
  list(JOIN modules " " requires)
  list(JOIN libraries " " libraries)
  list(JOIN others " " others)
  set(use ${uses_${top}})
  set(name ${name_${top}})
  configure_file(${CMAKE_CURRENT_LIST_DIR}/oiler.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc
          DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
# The licences of what is compiled into the programs, as Debian's packages keep them.
foreach(embedded fonts-dejavu-core libjs-chart.js libstb-dev python3-glad libcli11-dev
                 nlohmann-json3-dev libeigen3-dev libimgui-dev)
  install(FILES /usr/share/doc/${embedded}/copyright
          DESTINATION ${CMAKE_INSTALL_DOCDIR}/licences RENAME ${embedded} OPTIONAL)
endforeach()

# Packages to link a game, and packages that the programs load at run time: SDL2 and GL for a
# window, EGL without one. OSMesa, where Debian has it, is recommended. dpkg-shlibdeps adds the
# shared libraries that they link.
set(build_needs pkg-config libfmt-dev libimgui-dev libxxhash-dev libdeflate-dev libtomlplusplus-dev)
set(run_needs libsdl2-2.0-0 libegl1 libgl1 libgl1-mesa-dri)
list(JOIN build_needs ", " CPACK_DEBIAN_PACKAGE_DEPENDS)
list(JOIN run_needs ", " run_needs)
string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS ", ${run_needs}")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "cmake, g++, make | ninja-build, libosmesa6")
set(CPACK_DEBIAN_PACKAGE_SECTION devel)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGE_NAME oiler)
set(CPACK_PACKAGE_VENDOR "the Oiler contributors")
set(CPACK_PACKAGE_CONTACT "the Oiler contributors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_FILE_NAME
    oiler-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
