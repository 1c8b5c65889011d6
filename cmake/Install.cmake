# find_package(swell) for programs that embed the library: link swell::render.
include(CMakePackageConfigHelpers)
include(PublicHeaders)
swell_find_public_headers(ignored ${CMAKE_SOURCE_DIR})  # a name without a file is an error now
install(CODE "set(swell_source_folder \"${CMAKE_SOURCE_DIR}\")")
install(SCRIPT cmake/InstallHeaders.cmake)
install(EXPORT swell-targets NAMESPACE swell:: DESTINATION lib/cmake/swell)
configure_package_config_file(${CMAKE_SOURCE_DIR}/cmake/swellConfig.cmake.in
  ${CMAKE_BINARY_DIR}/swellConfig.cmake INSTALL_DESTINATION lib/cmake/swell)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/swellConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/swellConfig.cmake ${CMAKE_BINARY_DIR}/swellConfigVersion.cmake
  cmake/Dependencies.cmake DESTINATION lib/cmake/swell)
