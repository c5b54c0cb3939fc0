# SPDX-License-Identifier: BSD-3-Clause

# hoctomap_library(NAME SOURCES a.cpp ... PUBLIC dep ... PRIVATE dep ...)
# One library of libs/, with its own include root: a forbidden include does not compile.
function(hoctomap_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  add_library(hoctomap_${name} STATIC ${ARG_SOURCES})
  add_library(hoctomap::${name} ALIAS hoctomap_${name})
  target_include_directories(hoctomap_${name} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(hoctomap_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} hoctomap_flags)
  hoctomap_precompile(hoctomap_${name} library)
endfunction()

# Assertions gain nothing from being optimised and take a third of the compile time of a test.
set(HOCTOMAP_TEST_OPTIONS $<$<NOT:$<CONFIG:Debug>>:-O1>)

# hoctomap_test(NAME SOURCES a.cpp ... LINK lib ...)
# One GoogleTest program of tests/NAME; every TEST becomes a CTest test.
function(hoctomap_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(test_${name} ${ARG_SOURCES})
  target_link_libraries(test_${name} PRIVATE ${ARG_LINK} hoctomap_test_support hoctomap_flags)
  target_compile_options(test_${name} PRIVATE ${HOCTOMAP_TEST_OPTIONS})
  hoctomap_precompile(test_${name} test)
  gtest_discover_tests(test_${name} TEST_PREFIX "${name}/" DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 300)
endfunction()
