# What the library links; all are Debian 12 packages (scripts/packages.txt). The installed package
# reads this file too.
include(CMakeFindDependencyMacro)

# find_dependency gives up silently unless a required package is being looked for: our own build
# says that it is one.
if(NOT DEFINED CMAKE_FIND_PACKAGE_NAME)
  set(CMAKE_FIND_PACKAGE_NAME swell)
  set(swell_FIND_REQUIRED TRUE)
  set(swell_is_building TRUE)
endif()

find_dependency(Threads)
find_dependency(TBB)
find_dependency(glm)
find_dependency(hwy)
find_dependency(fmt)
find_dependency(tomlplusplus)
find_dependency(nlohmann_json)
find_dependency(ZLIB)
find_dependency(PNG)
find_dependency(PkgConfig)
pkg_check_modules(XXHash REQUIRED IMPORTED_TARGET GLOBAL libxxhash)

if(swell_is_building)
  # For the module that reads images and writes EXR and TIFF; what embeds the library does not link it. OpenImageIO's own
  # CMake files name folders of packages that Debian does not make it depend on.
  pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO)
  # For the program that reads mesh files.
  pkg_check_modules(Assimp REQUIRED IMPORTED_TARGET GLOBAL assimp)
  find_package(meshoptimizer REQUIRED)
  unset(CMAKE_FIND_PACKAGE_NAME)
  unset(swell_FIND_REQUIRED)
  unset(swell_is_building)
endif()
