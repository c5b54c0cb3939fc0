# SPDX-License-Identifier: BSD-3-Clause

# hoctomap_library(NAME SOURCES a.cpp ... PUBLIC dep ... PRIVATE dep ... BUILD_ONLY dep ...)
# One library of libs/, with its own include root: a forbidden include does not compile. It is installed with all
# headers below include/, and exported as hoctomap::NAME. BUILD_ONLY: headers that only its sources include, which
# who links the installed library need not have.
function(hoctomap_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;PUBLIC;PRIVATE;BUILD_ONLY" ${ARGN})
  add_library(hoctomap_${name} STATIC ${ARG_SOURCES})
  add_library(hoctomap::${name} ALIAS hoctomap_${name})
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS "${CMAKE_CURRENT_SOURCE_DIR}/include/*.h")
  target_sources(hoctomap_${name} PUBLIC
    FILE_SET HEADERS BASE_DIRS "${CMAKE_CURRENT_SOURCE_DIR}/include" FILES ${headers})
  target_compile_features(hoctomap_${name} PUBLIC cxx_std_20)
  list(TRANSFORM ARG_BUILD_ONLY REPLACE "(.+)" "$<BUILD_INTERFACE:\\1>")
  target_link_libraries(hoctomap_${name}
    PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE} ${ARG_BUILD_ONLY} $<BUILD_INTERFACE:hoctomap_flags>)
  set_target_properties(hoctomap_${name} PROPERTIES EXPORT_NAME ${name})
  hoctomap_precompile(hoctomap_${name} library)
  set_property(GLOBAL APPEND PROPERTY HOCTOMAP_INSTALLED hoctomap_${name})
  install(TARGETS hoctomap_${name} EXPORT hoctomapTargets
    ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT development
    FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT development)
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
