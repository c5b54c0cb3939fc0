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

/// As exportOctrees() with `.bt`, and with an index `mapcollection.txt` that OctoMap's MapCollection reads:
/// nodes by id, each with its file and its pose in the world (x y z roll pitch yaw, metres and radians).
std::vector<Damage> exportMapCollection(const std::filesystem::path& map, const Manifest& manifest,
                                        const std::filesystem::path& folder);

/// The octree of one node, in its frame. @throws MapError if it is damaged
[[nodiscard]] std::string octreeBytes(const std::filesystem::path& map, const NodeRecord& node,
                                      OctreeFormat format);

/// All nodes but the root as CSV:
/// `node,label,parent,existence,x,y,z,yaw,pitch,roll,box_x,box_y,box_z,size_x,size_y,
/// size_z,volume,occupied_voxels,resolution,first_scan,last_scan`: the pose in the world, the centre of the
/// box in the world, the lengths of its sides along the node's axes (m, degrees), and the volume of the
/// occupied voxels (m^3).
[[nodiscard]] std::string objectTable(const Manifest& manifest);

}  // namespace hoctomap
