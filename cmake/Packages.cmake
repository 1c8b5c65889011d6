# Debian packages, by cpack: one for each component of the install, for the Debian and the processor that it runs on.
# scripts/package.sh makes them from a clone.
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
# Whoever gives packages out names somebody who answers for them.
set(SWELL_PACKAGE_CONTACT "The Swell authors <authors@swell.invalid>" CACHE STRING "The maintainer of the packages")
set(CPACK_PACKAGE_CONTACT "${SWELL_PACKAGE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_SOURCE swell)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)  # of what is linked, by dpkg-shlibdeps
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_BINARY_DIR}/lib)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_VERBATIM_VARIABLES ON)

# swell_add_package(NAME SECTION S DESCRIPTION LINE... [DEPENDS D] [RECOMMENDS R] [SUGGESTS S] [ARCHITECTURE A]
# [CONTROL FILE...]): the component NAME as a package. The first line of its description is the summary.
macro(swell_add_package name)
  cmake_parse_arguments(ARG "" "SECTION;DEPENDS;RECOMMENDS;SUGGESTS;ARCHITECTURE" "DESCRIPTION;CONTROL" ${ARGN})
  list(APPEND CPACK_COMPONENTS_ALL ${name})
  string(TOUPPER ${name} upper)
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  foreach(field SECTION DEPENDS RECOMMENDS SUGGESTS ARCHITECTURE)
    set(CPACK_DEBIAN_${upper}_PACKAGE_${field} "${ARG_${field}}")
  endforeach()
  set(CPACK_DEBIAN_${upper}_PACKAGE_CONTROL_EXTRA "${ARG_CONTROL}")
  list(JOIN ARG_DESCRIPTION "\n" CPACK_DEBIAN_${upper}_DESCRIPTION)
  install(CODE "set(swell_package ${name})
set(swell_version ${PROJECT_VERSION})
set(swell_contact \"${SWELL_PACKAGE_CONTACT}\")" COMPONENT ${name} EXCLUDE_FROM_ALL)
  install(SCRIPT cmake/InstallNotes.cmake COMPONENT ${name} EXCLUDE_FROM_ALL)
endmacro()

set(same "(= ${PROJECT_VERSION})")
set(modules "swell-images ${same}, swell-meshes ${same}")

swell_add_package(libswell0 SECTION libs RECOMMENDS "${modules}" CONTROL ${CMAKE_SOURCE_DIR}/capi/debian/triggers
  DESCRIPTION "real-time ocean renderer for CPUs (C library)"
  "Swell draws the sea on CPU cores, with the same pixels on every run, and"
  "answers what the water is like at any place and time. This package has the"
  "library that programs in C and other languages call.")
swell_add_package(libswell-dev SECTION libdevel DEPENDS "libswell0 ${same}"
  # For C++ (Dependencies.cmake); C needs none of them.
  RECOMMENDS "cmake, pkg-config, libtbb-dev, libglm-dev, libhwy-dev, libfmt-dev, libtomlplusplus-dev, \
nlohmann-json3-dev, zlib1g-dev, libpng-dev, libxxhash-dev"
  DESCRIPTION "real-time ocean renderer for CPUs (development files)"
  "Headers, static libraries, CMake and pkg-config files of Swell, for programs in"
  "C and C++. The recommended packages are for C++ alone.")
swell_add_package(swell SECTION graphics RECOMMENDS "${modules}" 
  SUGGESTS "swell-doc, swell-sim, swell-view, libegl1, libgl1-mesa-dri"  # these two for swell-bench peer
  DESCRIPTION "real-time ocean renderer for CPUs (programs and scenes)"
  "Swell draws the sea on CPU cores, with the same pixels on every run."
  "swell-render draws pictures and sequences with labels, swell-dataset labelled"
  "data sets, and swell-bench measures. None needs a window.")
swell_add_package(swell-sim SECTION science RECOMMENDS "swell ${same}, ${modules}"
  DESCRIPTION "real-time ocean renderer for CPUs (sensors)"
  "swell-sim runs the cameras, lidars and other sensors of a boat in a sea of"
  "Swell, and records or publishes what they measure.")
swell_add_package(swell-images SECTION graphics
  DESCRIPTION "real-time ocean renderer for CPUs (image files)"
  "The module by which Swell reads image files and writes other formats than PNG,"
  "with OpenImageIO.")
swell_add_package(swell-meshes SECTION graphics
  DESCRIPTION "real-time ocean renderer for CPUs (mesh files)"
  "The program by which Swell reads mesh files (OBJ, glTF, STL and COLLADA), with"
  "Assimp.")
swell_add_package(swell-doc SECTION doc ARCHITECTURE all
  DESCRIPTION "real-time ocean renderer for CPUs (documents and examples)"
  "First steps, how-tos, reference and explanations of Swell, and examples in"
  "Python and C++.")
if(SWELL_BUILD_APPS AND SWELL_HAS_VIEWER)
  swell_add_package(swell-view SECTION graphics RECOMMENDS "swell ${same}, ${modules}"
    DESCRIPTION "real-time ocean renderer for CPUs (viewer)"
    "swell-view flies through a scene of Swell in a window, or in a browser that it"
    "serves.")
endif()
if(SWELL_HAS_PYTHON)
  swell_add_package(python3-swell SECTION python DEPENDS "libswell0 ${same}, ${SWELL_PYTHON_DEPENDS}"
    RECOMMENDS "${modules}" SUGGESTS swell
    CONTROL ${CMAKE_SOURCE_DIR}/python/debian/postinst ${CMAKE_SOURCE_DIR}/python/debian/prerm
    DESCRIPTION "real-time ocean renderer for CPUs (Python 3)"
    "Pictures of the sea with labels as NumPy arrays, and heights, slopes and"
    "velocities of its water.")
endif()
include(CPack)
