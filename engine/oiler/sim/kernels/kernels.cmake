# SPDX-License-Identifier: MIT
# The kernels of the step, for each instruction set in OILER_KERNELS and each precision. They are
# always optimised: without inlining, the sets would share functions of the standard library.
set(OILER_KERNELS native CACHE STRING
    "Instruction sets to compile kernels for: native (this machine's widest), all, none, or a list of baseline, avx2, avx512")

set(flags_baseline)
set(flags_avx2 -mavx2)
set(flags_avx512 -mavx512f -mavx512bw -mavx512dq -mavx512vl)
set(every_set baseline)
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND every_set avx2 avx512)
endif()

set(sets ${OILER_KERNELS})
if(sets STREQUAL all)
  set(sets ${every_set})
elseif(sets STREQUAL none)
  set(sets)
elseif(sets STREQUAL native)
  set(sets baseline)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64" AND NOT CMAKE_CROSSCOMPILING)
    if(NOT DEFINED OILER_NATIVE_KERNELS)
      try_run(OILER_NATIVE_RAN OILER_NATIVE_COMPILED SOURCES ${CMAKE_CURRENT_SOURCE_DIR}/kernels/native.c
              RUN_OUTPUT_VARIABLE native)
      set(OILER_NATIVE_KERNELS ${native} CACHE INTERNAL "This machine's widest instruction set")
    endif()
    set(sets ${OILER_NATIVE_KERNELS})
  endif()
endif()

# So that other sets recompile this file alone.
set_source_files_properties(kernels/kernels.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
foreach(name IN LISTS sets)
  if(NOT name IN_LIST every_set)
    message(FATAL_ERROR "OILER_KERNELS has ${name}: give native, all, none, or a list of ${every_set}")
  endif()
  foreach(precision float double)
    set(kernels oiler_kernels_${name}_${precision})
    add_library(${kernels} OBJECT kernels/kernels_of_set.cpp)
    target_link_libraries(${kernels} PRIVATE oiler::options oiler_warnings fmt::fmt)
    target_compile_definitions(${kernels} PRIVATE
      OILER_INSTRUCTIONS=${name} OILER_PRECISION=${precision} NDEBUG)
    # gcc warns of its own _mm512_undefined_ps().
    target_compile_options(${kernels} PRIVATE -O2 -fno-math-errno -fno-trapping-math
      $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized> ${flags_${name}})
    target_sources(oiler_sim PRIVATE $<TARGET_OBJECTS:${kernels}>)
    set_property(TARGET oiler_sim APPEND PROPERTY OILER_KERNEL_OBJECTS $<TARGET_OBJECTS:${kernels}>)
  endforeach()
  string(TOUPPER OILER_KERNELS_${name} built)
  set_property(SOURCE kernels/kernels.cpp APPEND PROPERTY COMPILE_DEFINITIONS ${built})
  set_property(TARGET oiler_sim APPEND PROPERTY OILER_KERNELS_BUILT ${built})
endforeach()
