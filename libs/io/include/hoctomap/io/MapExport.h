// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <vector>

#include "hoctomap/io/Manifest.h"
#include "hoctomap/io/MapCheck.h"

namespace hoctomap {

enum class OctreeFormat {
  ot,  ///< full probabilities
  bt,  ///< maximum likelihood
};

/// Writes the octree of every node of a map to a folder, one file a node: `NNNNNN.ot` or `.bt`, in the node's
/// frame. `nodes.csv` says where they are: id, label, parent, file, resolution and existence, and the pose in
/// the world (metres, degrees).
///
/// What is damaged is passed over, so that the rest of a damaged map can be saved.
/// @returns the damaged files of the nodes that are missing
/// @throws ConfigError if the folder holds anything; FileError if it cannot be written.
std::vector<Damage> exportOctrees(const std::filesystem::path& map, const Manifest& manifest,
                                  const std::filesystem::path& folder, OctreeFormat format);

}  // namespace hoctomap
