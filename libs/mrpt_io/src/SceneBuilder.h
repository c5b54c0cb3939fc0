// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/opengl/COpenGLScene.h>

#include <set>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

struct SceneParts {
  /// The occupied voxels as one shaded surface, rather than as MRPT's voxel object: without the inner faces,
  /// whose edges shine through between voxels.
  bool surface = false;
  bool boxes = true;         ///< wireframes of the nodes' boxes
  bool texts = true;         ///< labels and existence
  std::set<Label> hidden{};  ///< nodes of these labels are empty groups
};

/// The map as nested groups, the root's first.
[[nodiscard]] mrpt::opengl::CSetOfObjects::Ptr sceneOf(const MapHierarchy& hierarchy,
                                                       const SceneParts& parts);

}  // namespace hoctomap
