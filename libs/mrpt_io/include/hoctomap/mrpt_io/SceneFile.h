// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// Writes a map as `.3Dscene` for MRPT's SceneViewer3D: the tree of nodes as nested groups, each with its
/// occupied voxels (coloured by label), its box, and its label and existence as text. Same map, same bytes.
/// @throws FileError
void writeSceneFile(const MapHierarchy& hierarchy, const std::filesystem::path& file);

}  // namespace hoctomap
