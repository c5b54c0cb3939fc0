# SPDX-License-Identifier: BSD-3-Clause
# Headers of other projects that most files include, parsed once a build instead of once a file: a third of
# the time of a build from scratch. Sources still include what they use: presets `asan-ubsan` and `tidy` build
# without.
option(HOCTOMAP_PRECOMPILE "Precompile the headers of Eigen, OctoMap, MRPT and GoogleTest" OFF)

set(HOCTOMAP_COMMON_HEADERS
  <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional> <span> <sstream> <string>
  <variant> <vector>
  <Eigen/Geometry> <mrpt/poses/CPose3D.h> <octomap/OcTree.h>)

# One set of headers for each way of compiling: libraries, programs, tests.
function(_hoctomap_precompiled_headers name code_model)
  file(CONFIGURE OUTPUT "${CMAKE_BINARY_DIR}/${name}.cpp" CONTENT "// Only here to own the precompiled headers.\n")
  add_library(${name} OBJECT "${CMAKE_BINARY_DIR}/${name}.cpp")
  set_target_properties(${name} PROPERTIES POSITION_INDEPENDENT_CODE OFF)
  target_compile_options(${name} PRIVATE ${code_model})
  target_link_libraries(${name} PRIVATE Eigen3::Eigen mrpt::poses octomap hoctomap_flags ${ARGN})
  target_precompile_headers(${name} PRIVATE ${HOCTOMAP_COMMON_HEADERS})
endfunction()

if(HOCTOMAP_PRECOMPILE)
  _hoctomap_precompiled_headers(hoctomap_library_headers -fPIC)
  _hoctomap_precompiled_headers(hoctomap_program_headers -fPIE)
  if(BUILD_TESTING)
    _hoctomap_precompiled_headers(hoctomap_test_headers "-fPIE;${HOCTOMAP_TEST_OPTIONS}" GTest::gtest)
    target_precompile_headers(hoctomap_test_headers PRIVATE <gtest/gtest.h>)
  endif()
endif()

# hoctomap_precompile(TARGET library|program|test)
function(hoctomap_precompile target kind)
  if(HOCTOMAP_PRECOMPILE)
    target_precompile_headers(${target} REUSE_FROM hoctomap_${kind}_headers)
  endif()
endfunction()
