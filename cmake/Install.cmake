# What is installed besides programs and libraries. Each file belongs to one component, which is a Debian package
# (Packages.cmake). find_package(swell) is for programs that embed the library (swellConfig.cmake.in has its components):
# link swell::render; with COMPONENTS C, which needs no other package: swell::swell.
include(CMakePackageConfigHelpers)
include(PublicHeaders)
swell_find_public_headers(ignored ${CMAKE_SOURCE_DIR})  # a name without a file is an error now
install(CODE "set(swell_source_folder \"${CMAKE_SOURCE_DIR}\")
set(swell_binary_folder \"${CMAKE_BINARY_DIR}\")" ALL_COMPONENTS)
install(SCRIPT cmake/InstallHeaders.cmake COMPONENT libswell-dev)
install(EXPORT swell-c-targets NAMESPACE swell:: DESTINATION lib/cmake/swell COMPONENT libswell-dev)
install(EXPORT swell-targets NAMESPACE swell:: DESTINATION lib/cmake/swell COMPONENT libswell-dev)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/swellConfig.cmake.in
  ${CMAKE_BINARY_DIR}/swellConfig.cmake INSTALL_DESTINATION lib/cmake/swell)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/swellConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/swellConfig.cmake ${CMAKE_BINARY_DIR}/swellConfigVersion.cmake
  cmake/Dependencies.cmake DESTINATION lib/cmake/swell COMPONENT libswell-dev)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scenes DESTINATION share/swell COMPONENT swell)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scripts/cluster ${CMAKE_SOURCE_DIR}/scripts/slurm
  DESTINATION share/swell COMPONENT swell
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE
  PATTERN arguments.sh PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
foreach(example cpp csharp embed gazebo node python ros2 rust wave_provider)
  install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples/${example} DESTINATION share/swell/examples COMPONENT swell-doc
    PATTERN start.sh PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endforeach()
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION share/doc/swell COMPONENT swell-doc
  FILES_MATCHING PATTERN "*.md" PATTERN images EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/CONTRIBUTING.md
  ${CMAKE_SOURCE_DIR}/SECURITY.md ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/swell COMPONENT swell-doc)

# All that is installed, to be built without the tests.
add_custom_target(swell_installed DEPENDS swell_package swell_mesh_import)
if(SWELL_BUILD_APPS)
  add_dependencies(swell_installed swell-render swell-dataset swell-sim swell-bench)
  if(SWELL_HAS_VIEWER)
    add_dependencies(swell_installed swell-view)
  endif()
endif()
