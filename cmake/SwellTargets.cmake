# swell_options: what every translation unit of ours is compiled with.
add_library(swell_options INTERFACE)
target_compile_options(swell_options INTERFACE
  $<BUILD_INTERFACE:-Wall;-Wextra;-Wpedantic;-Wshadow;-Wconversion;-Wno-sign-conversion;-Werror>
  # Highway's headers compare and convert freely inside its own namespaces.
  $<BUILD_INTERFACE:-Wno-psabi>
  # Per-target headers hold functions and settings that not every file includes them for.
  $<BUILD_INTERFACE:$<$<CXX_COMPILER_ID:Clang>:-Wno-unneeded-internal-declaration;-Wno-unused-function;-Wno-pragma-clang-attribute>>)
if(SWELL_SANITIZE)
  include(CheckLinkerFlag)
  target_compile_definitions(swell_options INTERFACE SWELL_SANITIZED)
  target_compile_options(swell_options INTERFACE -fsanitize=${SWELL_SANITIZE}
    -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(swell_options INTERFACE -fsanitize=${SWELL_SANITIZE})
  check_linker_flag(CXX -fuse-ld=lld SWELL_HAS_LLD)  # a third of a link's time
  if(SWELL_HAS_LLD)
    target_link_options(swell_options INTERFACE -fuse-ld=lld)
  endif()
  # What the address checks find where it does harm, for a fifth of the time that code with checks takes to compile.
  if(SWELL_SANITIZE MATCHES "address.*undefined")
    target_compile_options(swell_options INTERFACE -fno-sanitize=null,object-size,vptr,pointer-overflow)
  endif()
  # Where a function has over 500 accesses, calls check addresses: they find what Clang's usual checks find; shaders compile
  # in half the time.
  if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND SWELL_SANITIZE MATCHES "address.*undefined")
    target_compile_options(swell_options INTERFACE "SHELL:-mllvm -asan-instrumentation-with-call-threshold=500")
  endif()
  # Sanitized code makes GCC's flow warnings see paths that do not exist.
  set(flow_warnings -Wno-maybe-uninitialized -Wno-array-bounds -Wno-mismatched-new-delete
    -Wno-stringop-overflow)
  # GCC's analysis of what pointers point to takes half of the time of a shader with checks, for nothing.
  target_compile_options(swell_options INTERFACE
    "$<$<CXX_COMPILER_ID:GNU>:${flow_warnings};-fno-tree-pta>")
endif()

# For programs and tests, whose time is the library's: they compile in two thirds of the time at -O1, tests in half at -Og,
# and run as fast. GCC sees bounds in std::string and std::vector then that are not there.
set(swell_light_options $<$<CONFIG:Release>:-O1>)
set(swell_test_options $<$<CONFIG:Release>:-Og>)
foreach(warning alloc-size-larger-than array-bounds restrict stringop-overflow)
  list(APPEND swell_light_options $<$<CXX_COMPILER_ID:GNU>:-Wno-${warning}>)
  list(APPEND swell_test_options $<$<CXX_COMPILER_ID:GNU>:-Wno-${warning}>)
endforeach()

# For code that calls the library for its work: programs, and tests of pictures and files. Sanitized, it compiles in a
# third to a half of the time so.
set(swell_caller_options "")
if(SWELL_SANITIZE AND NOT SWELL_SANITIZE MATCHES "fuzzer")
  set(swell_caller_options -O0)
endif()

# swell_compile_as_library(FILE...): files among such code that do work of their own.
function(swell_compile_as_library)
  if(swell_caller_options)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS -O1 SKIP_PRECOMPILE_HEADERS ON)
  endif()
endfunction()

# -ffp-contract=off is a correctness flag: without it GCC fuses a*b+c where it likes, and
# pictures differ between optimisation levels and SIMD targets (docs/understand/sameness.md).
add_compile_options(-ffp-contract=off -fno-math-errno -fno-trapping-math)
# Names of sources in messages begin at the top of the sources: the same sources give the same bytes in any folder.
add_compile_options(-fmacro-prefix-map=${CMAKE_SOURCE_DIR}/= -fmacro-prefix-map=${CMAKE_BINARY_DIR}/=)
include(CheckCXXSourceCompiles)
if(CMAKE_CXX_FLAGS MATCHES "-ffast-math|-Ofast|-ffp-contract=(fast|on)|-march=native")
  message(FATAL_ERROR "CMAKE_CXX_FLAGS='${CMAKE_CXX_FLAGS}' would change pictures; remove the flag.")
endif()

# Headers that most files include, compiled once: a third of a folder's compile time. That files include what they use shows with
# CMAKE_DISABLE_PRECOMPILE_HEADERS (scripts/debian13.sh).
set(swell_common_headers <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <memory> <mutex> <optional> <span>
  <string> <string_view> <variant> <vector>)

# With CMAKE_UNITY_BUILD, as the presets have it, a target's files are compiled up to 32 at a time, in a third of the
# time: most of it goes into the headers of what they use. So names at the top of a file differ from those of its folder's
# other files. Vector code has units of its own, as each SIMD target reads them anew.
# swell_keep_apart(FILE...): leaves out vector code among the files, and what replaces operator new.
function(swell_keep_apart)
  list(FILTER ARGN INCLUDE REGEX "(_simd|/allocation_count)\\.cpp$")
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# swell_add_headers(NAME HEADERS ... [LINKS ...] [OPTIONS ...]): for targets compiled with the same options,
# target_precompile_headers(TARGET REUSE_FROM NAME).
file(WRITE ${CMAKE_BINARY_DIR}/empty.cpp "")
function(swell_add_headers name)
  cmake_parse_arguments(ARG "" "" "HEADERS;LINKS;OPTIONS" ${ARGN})
  add_library(${name} OBJECT ${CMAKE_BINARY_DIR}/empty.cpp)
  target_link_libraries(${name} PRIVATE ${ARG_LINKS} swell_options)
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  if("<glm/glm.hpp>" IN_LIST ARG_HEADERS)
    target_compile_definitions(${name} PRIVATE $<TARGET_PROPERTY:swell_math,INTERFACE_COMPILE_DEFINITIONS>)
  endif()
  target_precompile_headers(${name} PRIVATE ${ARG_HEADERS})
endfunction()
swell_add_headers(swell_folder_headers HEADERS ${swell_common_headers} <glm/glm.hpp>)
swell_add_headers(swell_light_folder_headers HEADERS ${swell_common_headers} <glm/glm.hpp>
  OPTIONS ${swell_light_options} ${swell_caller_options})
set_target_properties(swell_folder_headers swell_light_folder_headers PROPERTIES POSITION_INDEPENDENT_CODE ON)

# swell_add_folder(NAME [LIGHT] SOURCES ... LINKS ... PRIVATE_LINKS ...)
# LIGHT: no picture and no world waits for its code, which is compiled lightly.
# A static library of one folder. Its headers are visible as "folder/x.h" only to targets that
# link it, because each folder has an include root of its own: a wrong include does not build.
# cmake/PublicHeaders.cmake says which headers are installed.
function(swell_add_folder folder)
  cmake_parse_arguments(ARG "LIGHT" "" "SOURCES;LINKS;PRIVATE_LINKS" ${ARGN})
  set(root ${CMAKE_BINARY_DIR}/include/${folder})
  file(MAKE_DIRECTORY ${root})
  file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${folder} ${root}/${folder} SYMBOLIC)
  add_library(swell_${folder} STATIC ${ARG_SOURCES})
  swell_keep_apart(${ARG_SOURCES})
  add_library(swell::${folder} ALIAS swell_${folder})
  set_target_properties(swell_${folder} PROPERTIES EXPORT_NAME ${folder}
    POSITION_INDEPENDENT_CODE ON)
  if(ARG_LIGHT)
    target_compile_options(swell_${folder} PRIVATE ${swell_light_options} ${swell_caller_options})
    target_precompile_headers(swell_${folder} REUSE_FROM swell_light_folder_headers)
  else()
    target_precompile_headers(swell_${folder} REUSE_FROM swell_folder_headers)
  endif()
  target_include_directories(swell_${folder} PUBLIC
    $<BUILD_INTERFACE:${root}> $<INSTALL_INTERFACE:include>)
  target_link_libraries(swell_${folder} PUBLIC ${ARG_LINKS}
    PRIVATE $<BUILD_INTERFACE:swell_options> ${ARG_PRIVATE_LINKS})
  # What programs that embed the library must compile its headers with.
  target_compile_features(swell_${folder} INTERFACE cxx_std_20)
  target_compile_options(swell_${folder} INTERFACE $<INSTALL_INTERFACE:-ffp-contract=off>)
  install(TARGETS swell_${folder} EXPORT swell-targets COMPONENT libswell-dev)
endfunction()
