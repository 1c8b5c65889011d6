# find_package(swell) for programs that embed the library: link swell::render; with COMPONENTS C, which needs no other
# package: swell::swell.
include(CMakePackageConfigHelpers)
include(PublicHeaders)
swell_find_public_headers(ignored ${CMAKE_SOURCE_DIR})  # a name without a file is an error now
install(CODE "set(swell_source_folder \"${CMAKE_SOURCE_DIR}\")
set(swell_binary_folder \"${CMAKE_BINARY_DIR}\")")
install(SCRIPT cmake/InstallHeaders.cmake)
install(EXPORT swell-c-targets NAMESPACE swell:: DESTINATION lib/cmake/swell)
install(EXPORT swell-targets NAMESPACE swell:: DESTINATION lib/cmake/swell)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/swellConfig.cmake.in
  ${CMAKE_BINARY_DIR}/swellConfig.cmake INSTALL_DESTINATION lib/cmake/swell)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/swellConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/swellConfig.cmake ${CMAKE_BINARY_DIR}/swellConfigVersion.cmake
  cmake/Dependencies.cmake DESTINATION lib/cmake/swell)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scenes DESTINATION share/swell)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/scripts/cluster ${CMAKE_SOURCE_DIR}/scripts/slurm
  DESTINATION share/swell USE_SOURCE_PERMISSIONS)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/examples/python ${CMAKE_SOURCE_DIR}/examples/wave_provider
  DESTINATION share/swell/examples)
install(DIRECTORY ${CMAKE_SOURCE_DIR}/docs DESTINATION share/doc/swell
  FILES_MATCHING PATTERN "*.md" PATTERN images EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/README.md ${CMAKE_SOURCE_DIR}/CHANGELOG.md ${CMAKE_SOURCE_DIR}/CONTRIBUTING.md
  ${CMAKE_SOURCE_DIR}/SECURITY.md ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/swell)
# Where Debian looks for a package's licence.
install(FILES ${CMAKE_SOURCE_DIR}/LICENSE DESTINATION share/doc/swell RENAME copyright)

# cpack makes a .deb for the Debian it runs on: programs, libraries, headers, scenes, the Python package.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# Whoever gives packages out names somebody who answers for them.
set(SWELL_PACKAGE_CONTACT "The Swell authors <authors@swell.invalid>" CACHE STRING "The maintainer of the .deb")
set(CPACK_PACKAGE_CONTACT "${SWELL_PACKAGE_CONTACT}")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # of what is linked, by dpkg-shlibdeps
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "python3, python3-numpy")
# To compile C++ with the library (Dependencies.cmake); C needs none of them.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "cmake, pkg-config, libtbb-dev, libglm-dev, libhwy-dev, libfmt-dev, \
libtomlplusplus-dev, nlohmann-json3-dev, zlib1g-dev, libpng-dev, libxxhash-dev")
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_VERBATIM_VARIABLES ON)
include(CPack)
