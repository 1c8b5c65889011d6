# Run by cmake --install, so that headers that have changed since cmake ran are followed as well. They are installed below
# include/swell, and include each other as <swell/folder/header.h>: a program's own folders may have any name.
# swell_source_folder: where the headers are. swell_binary_folder: where they are rewritten.
cmake_policy(VERSION 3.25)
include(${swell_source_folder}/cmake/PublicHeaders.cmake)
swell_find_public_headers(headers ${swell_source_folder})
foreach(header IN LISTS headers)
  get_filename_component(folder ${header} DIRECTORY)
  file(READ ${swell_source_folder}/${header} text)
  string(REGEX REPLACE "(^|\n) *# *include +\"([^\"]*)\"" "\\1#include <swell/\\2>" text "${text}")
  file(WRITE ${swell_binary_folder}/installed_headers/${header} "${text}")
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/include/swell/${folder} TYPE FILE
    FILES ${swell_binary_folder}/installed_headers/${header})
endforeach()
