# Headers that nearly every file includes, parsed once. Files still include what they use: a build with
# -DBN_PRECOMPILE=OFF, as scripts/check-odr makes, must pass.

# What is tested is optimised fully; tests themselves compile a third faster without, and run as long. Some libraries ask
# for -pthread, so all tests have it.
set(BN_TEST_OPTIONS -pthread $<$<CONFIG:Release>:-O1>)

set(precompiled_standard <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional>
  <string> <string_view> <utility> <vector>)

# g++ 12 no longer sees that what it warns of is inside std::string and was checked by others.
if(BN_PRECOMPILE)
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds> $<$<CXX_COMPILER_ID:GNU>:-Wno-stringop-overflow>)
endif()

file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp "")
if(BN_PRECOMPILE)
  add_library(bn_precompiled OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(bn_precompiled PRIVATE fmt::fmt)
  target_precompile_headers(bn_precompiled PRIVATE ${precompiled_standard} <fmt/format.h>)
endif()
if(BN_PRECOMPILE AND BN_BUILD_TESTS)
  add_library(bn_precompiled_tests OBJECT ${CMAKE_CURRENT_BINARY_DIR}/precompiled.cpp)
  target_link_libraries(bn_precompiled_tests PRIVATE GTest::gtest)
  target_compile_options(bn_precompiled_tests PRIVATE ${BN_TEST_OPTIONS})
  target_precompile_headers(bn_precompiled_tests PRIVATE ${precompiled_standard} <gtest/gtest.h>)
endif()

# bn_precompile(bn_noise FROM bn_precompiled) for a target with the same options.
function(bn_precompile target from source)
  if(BN_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM ${source})
  endif()
endfunction()
