# SPDX-License-Identifier: BSD-3-Clause
set(HOCTOMAP_ENGINE_SOURCES
  src/BlockScanUpdate.cpp src/BlockView.cpp src/BulkUpdate.cpp src/RayClip.cpp src/RayMarker.cpp src/RayTraversal.cpp
  src/VoxelBlocks.cpp)
