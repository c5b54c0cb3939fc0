# SPDX-License-Identifier: BSD-3-Clause
# The scene part of this library: 3D scenes and pictures of maps.
find_package(mrpt-opengl 2.5 REQUIRED)
find_package(PNG REQUIRED)
set(HOCTOMAP_MRPT_IO_SCENE_SOURCES
  src/RenderCamera.cpp
  src/RenderMap.cpp
  src/SceneBuilder.cpp
  src/SceneFile.cpp)
set(HOCTOMAP_MRPT_IO_SCENE_LIBRARIES mrpt::opengl PNG::PNG)
