# What the library links; all are Debian 12 packages (scripts/packages.txt). The installed package
# reads this file too.
include(CMakeFindDependencyMacro)

find_dependency(Threads)
find_dependency(TBB)
find_dependency(glm)
find_dependency(hwy)
find_dependency(fmt)
find_dependency(tomlplusplus)
# OpenImageIO's own CMake files name folders of packages that Debian does not make it depend on.
find_dependency(PkgConfig)
pkg_check_modules(OpenImageIO REQUIRED IMPORTED_TARGET GLOBAL OpenImageIO)
pkg_check_modules(XXHash REQUIRED IMPORTED_TARGET GLOBAL libxxhash)
