# SPDX-License-Identifier: MIT
# The same sources compiled without and with optimisation and for old and new machines must give the
# same bits, with the kernels of every set of instructions. Each program compiles all else of core,
# sim and world anew, so that no variant's code can stand in for another's.
include(CheckCXXCompilerFlag)

set(bits_sources ${CMAKE_CURRENT_LIST_DIR}/state_hash.cpp)
foreach(room core sim world)
  get_target_property(room_sources oiler_${room} SOURCES)
  foreach(file IN LISTS room_sources)
    if(file MATCHES "\\.cpp$")
      cmake_path(ABSOLUTE_PATH file BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/engine/oiler)
      list(APPEND bits_sources ${file})
    endif()
  endforeach()
endforeach()
get_directory_property(bits_kernels DIRECTORY ${PROJECT_SOURCE_DIR}/engine/oiler DEFINITION OILER_KERNELS)
foreach(name IN LISTS bits_kernels)
  list(APPEND bits_sources $<TARGET_OBJECTS:oiler_kernels_${name}>)
  list(APPEND bits_kernel_objects $<TARGET_OBJECTS:oiler_kernels_${name}>)
endforeach()

# oiler_bits(NAME option...): the program bits_NAME, compiled with these options last.
function(oiler_bits name)
  add_executable(bits_${name} ${bits_sources})
  target_link_libraries(bits_${name} PRIVATE oiler_options fmt::fmt Eigen3::Eigen PkgConfig::bits_xxhash)
  target_compile_definitions(bits_${name} PRIVATE OILER_VERSION="${PROJECT_VERSION}"
                                                 $<$<IN_LIST:avx2,${bits_kernels}>:OILER_X86>)
  target_compile_options(bits_${name} PRIVATE -Wno-psabi ${ARGN})
endfunction()

pkg_check_modules(bits_xxhash REQUIRED IMPORTED_TARGET libxxhash)
find_package(fmt REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)

set(bits_programs)
foreach(variant "o0 -O0 -march=x86-64" "v4 -O3 -march=x86-64-v4")
  separate_arguments(options UNIX_COMMAND "${variant}")
  list(POP_FRONT options name)
  list(GET options -1 march)
  string(MAKE_C_IDENTIFIER "oiler_takes${march}" takes)
  check_cxx_compiler_flag(${march} ${takes})
  if(${takes})
    oiler_bits(${name} ${options})
    list(APPEND bits_programs $<TARGET_FILE:bits_${name}>)
  endif()
endforeach()

if(bits_programs)
  add_test(NAME bits_agree COMMAND ${CMAKE_CURRENT_LIST_DIR}/agree.sh ${bits_programs})
endif()
add_test(NAME kernels_share_no_function
         COMMAND ${CMAKE_CURRENT_LIST_DIR}/weak_symbols.sh ${bits_kernel_objects})
