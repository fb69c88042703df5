# SPDX-License-Identifier: MIT
# For the preset `web`, which builds pages with emscripten: find_package finds Debian's headers, which
# hold on every processor, and compiles the two libraries that have sources. Their archives are in the
# folder OILER_WEB_PACKAGES:
#   apt-get source --download-only --tar-only imgui libdeflate
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE BOTH)  # files that are embedded
set(OILER_STB_INCLUDE /usr/include/stb)
set(OILER_WEB_PACKAGES ${CMAKE_BINARY_DIR}/packages CACHE PATH "Archives of imgui and libdeflate")

# Clang 19 crashes where it computes a function of a constant long double. So it is told that these
# are functions of which it knows nothing.
set(web_unknown ${CMAKE_BINARY_DIR}/unknown.h)
set(declarations)
foreach(function ceil cos exp exp2 fabs floor log2 nearbyint round sin sqrt trunc)
  string(APPEND declarations "long double ${function}l(long double);\n")
  add_compile_options($<$<COMPILE_LANGUAGE:CXX>:-fno-builtin-${function}l>
                      $<$<COMPILE_LANGUAGE:CXX>:-D__builtin_${function}l=${function}l>)
endforeach()
file(CONFIGURE OUTPUT ${web_unknown} CONTENT "extern \"C\" {\n${declarations}}\n" @ONLY)
add_compile_options("$<$<COMPILE_LANGUAGE:CXX>:SHELL:-include ${web_unknown}>")

add_compile_options(-msimd128 $<$<COMPILE_LANGUAGE:CXX>:-fwasm-exceptions>
                    $<$<COMPILE_LANGUAGE:CXX>:-fexperimental-library>)  # for std::jthread
add_link_options(-fwasm-exceptions)

# Only these: other headers of the machine do not hold for WebAssembly.
set(web_include ${CMAKE_BINARY_DIR}/include)
foreach(header fmt toml++ CLI nlohmann xxhash.h xxh3.h stb)
  if(NOT EXISTS /usr/include/${header})
    message(FATAL_ERROR "/usr/include/${header} not found: install the packages of README.md")
  endif()
  file(MAKE_DIRECTORY ${web_include})
  file(CREATE_LINK /usr/include/${header} ${web_include}/${header} SYMBOLIC)
endforeach()

function(web_library name includes)
  if(NOT TARGET ${name})
    add_library(${name} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${name} SYSTEM INTERFACE ${includes})
    target_compile_definitions(${name} INTERFACE ${ARGN})
  endif()
endfunction()

# web_sources NAME FILE...: compiles files of the archive NAME.
function(web_sources name)
  file(GLOB archive ${OILER_WEB_PACKAGES}/${name}_*.orig.tar.*)
  if(NOT archive)
    message(FATAL_ERROR "no archive of ${name} in ${OILER_WEB_PACKAGES}: run there"
                        " apt-get source --download-only --tar-only imgui libdeflate")
  endif()
  set(folder ${CMAKE_BINARY_DIR}/${name})
  if(NOT EXISTS ${folder})
    file(ARCHIVE_EXTRACT INPUT ${archive} DESTINATION ${folder})
  endif()
  file(GLOB folder ${folder}/*)
  list(TRANSFORM ARGN PREPEND ${folder}/)
  add_library(web_${name} STATIC ${ARGN})
  target_compile_options(web_${name} PRIVATE -w)
  web_library(PkgConfig::OILER_${name} ${folder})
  target_link_libraries(PkgConfig::OILER_${name} INTERFACE web_${name})
endfunction()

# The rooms ask for them by name; they are all here.
macro(provide_web_package method name)
  set(${name}_FOUND TRUE)
  if(NOT TARGET Threads::Threads)
    web_library(Threads::Threads "")
    web_library(fmt::fmt ${web_include} FMT_HEADER_ONLY)
    web_library(CLI11::CLI11 ${web_include})
    web_library(nlohmann_json::nlohmann_json ${web_include})
    web_library(Eigen3::Eigen /usr/include/eigen3)
    web_library(PkgConfig::OILER_libxxhash ${web_include} XXH_INLINE_ALL)
    # Its vectors are those of ARM, translated by a header that Debian lacks.
    target_compile_options(PkgConfig::OILER_libxxhash INTERFACE -mno-simd128)
    web_library(PkgConfig::OILER_tomlplusplus ${web_include})
  endif()
endmacro()
cmake_language(SET_DEPENDENCY_PROVIDER provide_web_package SUPPORTED_METHODS FIND_PACKAGE)

function(pkg_check_modules)
  if(ARGV0 STREQUAL OILER_imgui)
    web_sources(imgui imgui.cpp imgui_draw.cpp imgui_tables.cpp imgui_widgets.cpp)
  elseif(ARGV0 STREQUAL OILER_libdeflate)
    web_sources(libdeflate lib/adler32.c lib/crc32.c lib/deflate_compress.c lib/deflate_decompress.c
                lib/gzip_compress.c lib/gzip_decompress.c lib/utils.c lib/zlib_compress.c)
  endif()
endfunction()
