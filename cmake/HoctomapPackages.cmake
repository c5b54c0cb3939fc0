# SPDX-License-Identifier: BSD-3-Clause
# Debian packages by CPack, a package a component: `cpack` in the build folder. scripts/package_test.sh builds and tries them.
# Dependencies on shared libraries are found by dpkg-shlibdeps; what no linker sees is named here.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hoctomap)
set(CPACK_PACKAGE_VENDOR "the hoctomap authors")
set(CPACK_PACKAGE_CONTACT "The hoctomap authors <hoctomap@users.noreply.github.com>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DIRECTORY "${CMAKE_BINARY_DIR}/packages")
set(CPACK_COMPONENTS_ALL program development python)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Under the summary, which is that of project().
set(about "hoctomap turns recorded 3D measurements with known sensor poses into a tree of\nlabelled submaps (background, tables, objects), each an OctoMap with its own\nframe, resolution and probability of existence.")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME hoctomap)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${about}\n.\nThis package has the program for the command line.")
# Pictures are drawn by Mesa without a display, plots by gnuplot.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri, gnuplot-nox")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhoctomap-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${about}\n.\nThis package has the static libraries, their headers and the CMake package.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "libeigen3-dev, liboctomap-dev, libmrpt-poses-dev, libmrpt-math-dev, libtbb-dev, libssl-dev, libpng-dev, libyaml-cpp-dev")
# Of the components simulation, scenes and mrpt_io.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS "libembree-dev, libassimp-dev, libmrpt-obs-dev, libmrpt-maps-dev, libmrpt-opengl-dev, zlib1g-dev")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-hoctomap)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "${about}\n.\nThis package has the module for Python.")
if(HOCTOMAP_PYTHON)
  find_package(Python3 REQUIRED COMPONENTS Interpreter)
  math(EXPR next_minor "${Python3_VERSION_MINOR} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
    "python3 (>= 3.${Python3_VERSION_MINOR}), python3 (<< 3.${next_minor}), python3-numpy")
else()
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL python)
endif()

# Every package tells its licence and its history. The day is SOURCE_DATE_EPOCH's, if set.
string(TIMESTAMP HOCTOMAP_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
find_program(HOCTOMAP_GZIP gzip REQUIRED)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/package-documents/${component}")
  configure_file(packaging/changelog.Debian.in "${folder}/changelog.Debian" @ONLY)
  configure_file(packaging/copyright "${folder}/copyright" COPYONLY)
  configure_file(CHANGELOG.md "${folder}/changelog" COPYONLY)
  execute_process(COMMAND "${HOCTOMAP_GZIP}" -9nf changelog.Debian changelog WORKING_DIRECTORY "${folder}" COMMAND_ERROR_IS_FATAL ANY)
  install(DIRECTORY "${folder}/" DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}"
    COMPONENT ${component} EXCLUDE_FROM_ALL)
endforeach()
include(CPack)

# `packages` builds what is installed, and no more, and makes the packages of it.
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)
get_property(installed GLOBAL PROPERTY HOCTOMAP_INSTALLED)
add_custom_target(packages COMMAND "${CMAKE_CPACK_COMMAND}" DEPENDS ${installed} hoctomap_documentation
  hoctomap hoctomap-simulator hoctomap-mrpt hoctomap-cloud $<TARGET_NAME_IF_EXISTS:hoctomap_python>
  WORKING_DIRECTORY "${CMAKE_BINARY_DIR}" USES_TERMINAL VERBATIM)
