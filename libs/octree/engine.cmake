# SPDX-License-Identifier: BSD-3-Clause
set(HOCTOMAP_ENGINE_SOURCES
  src/BeamDensity.cpp src/BlockScanUpdate.cpp src/BlockView.cpp src/BulkUpdate.cpp src/DenseScan.cpp src/EndpointMarker.cpp
  src/FixedRayMarker.cpp src/MarkedReach.cpp src/RayBatch.cpp src/RayClip.cpp src/RayMarker.cpp src/RayTraversal.cpp src/ScanBeams.cpp
  src/ScanMarks.cpp src/UpdateMemory.cpp src/VoxelBits.cpp src/WideRayBatch.cpp src/WideRayMarker.cpp)
# Vectors are only handed between inlined functions: how their passing depends on the instruction set is no matter.
set_source_files_properties(src/BeamDensity.cpp src/DenseScan.cpp src/EndpointMarker.cpp src/UpdateMemory.cpp src/BlockScanUpdate.cpp src/BulkUpdate.cpp src/RayBatch.cpp src/RayMarker.cpp src/ScanBeams.cpp src/ScanMarks.cpp PROPERTIES COMPILE_OPTIONS -Wno-psabi)
# GCC 12 reports the undefined vectors of its own header.
set_source_files_properties(src/FixedRayMarker.cpp src/WideRayBatch.cpp src/WideRayMarker.cpp PROPERTIES COMPILE_OPTIONS "-Wno-psabi;-Wno-uninitialized;-Wno-maybe-uninitialized")
# Clang, of the presets for analysis, does not know `#pragma GCC target`.
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang" AND CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  set_property(SOURCE src/WideRayBatch.cpp APPEND PROPERTY COMPILE_OPTIONS
    -mavx512f -mavx512dq -mavx512vl -mavx2 -mbmi2 -mpopcnt)
  set_source_files_properties(src/WideRayBatch.cpp PROPERTIES SKIP_PRECOMPILE_HEADERS ON)  # they are of the plain machine
endif()
