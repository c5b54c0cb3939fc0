# SPDX-License-Identifier: BSD-3-Clause
# What is installed beside programs and libraries: the CMake package, and the configurations as examples.
# Components: program, development, python; cmake/HoctomapPackages.cmake makes a package of each.
include(CMakePackageConfigHelpers)
set(HOCTOMAP_INSTALL_CMAKEDIR "${CMAKE_INSTALL_LIBDIR}/cmake/hoctomap")

configure_package_config_file(cmake/hoctomapConfig.cmake.in hoctomapConfig.cmake
  INSTALL_DESTINATION "${HOCTOMAP_INSTALL_CMAKEDIR}")
# Before 1.0 a new minor version may change the interface (docs/release-checklist.md).
write_basic_package_version_file(hoctomapConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  "${CMAKE_CURRENT_BINARY_DIR}/hoctomapConfig.cmake" "${CMAKE_CURRENT_BINARY_DIR}/hoctomapConfigVersion.cmake"
  DESTINATION "${HOCTOMAP_INSTALL_CMAKEDIR}" COMPONENT development)
install(EXPORT hoctomapTargets NAMESPACE hoctomap::
  DESTINATION "${HOCTOMAP_INSTALL_CMAKEDIR}" COMPONENT development)

install(DIRECTORY configs/ DESTINATION "${CMAKE_INSTALL_DATADIR}/hoctomap/configs" COMPONENT program)
