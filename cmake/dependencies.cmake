# Debian 12 packages; scripts/packages.txt names them. Nothing is downloaded.

find_package(PkgConfig REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(Threads REQUIRED)
# The CMake configuration of Debian's OpenImageIO 2.4 names files that are not packaged.
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO>=2.4)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy>=1.0.3)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash>=0.8)
if(BN_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
if(BN_BUILD_BENCH)
  find_package(benchmark REQUIRED)
endif()
