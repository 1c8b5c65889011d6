# Run by cmake --install, so that headers that have changed since cmake ran are followed as well.
# swell_source_folder: where the headers are.
cmake_policy(VERSION 3.25)
include(${swell_source_folder}/cmake/PublicHeaders.cmake)
swell_find_public_headers(headers ${swell_source_folder})
foreach(header IN LISTS headers)
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL DESTINATION ${CMAKE_INSTALL_PREFIX}/include/swell/${folder} TYPE FILE
    FILES ${swell_source_folder}/${header})
endforeach()
