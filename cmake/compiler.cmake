# One place for what every translation unit is compiled with.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# The same bytes from every compiler: no contraction of a*b+c, no reassociation.
add_compile_options(-ffp-contract=off -fno-fast-math -Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion)
# g++ 12 sees an overlap in "literal" + std::string that is not there (GCC bug 105651).
add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# Proven, not hoped for: a product whose rounding error survives only under contraction.
include(CheckCXXSourceRuns)
set(CMAKE_REQUIRED_FLAGS "${CMAKE_CXX_FLAGS} -O2 -ffp-contract=off")
check_cxx_source_runs("
  int main(int argc, char**) {
    volatile double a = 1.0 + 0x1p-30 * argc, rounded = a * a;
    double x = a, c = -rounded;
    return x * x + c == 0.0 ? 0 : 1;
  }" BN_NO_CONTRACTION)
unset(CMAKE_REQUIRED_FLAGS)
if(NOT BN_NO_CONTRACTION)
  message(FATAL_ERROR "this compiler, or CMAKE_CXX_FLAGS, contracts a*b+c: results would differ between machines")
endif()
