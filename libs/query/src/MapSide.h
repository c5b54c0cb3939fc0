// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "VoxelTree.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A node other than the root, as the surface it is: its occupied voxels in A's world.
struct Thing {
  NodeId id;
  Label label;
  std::optional<NodeId> parent;  ///< none below the root
  double resolution = 0.0;       ///< m
  PointCloud voxels;             ///< centres
  PointCloud sample;             ///< some of them, evenly spread: what shares are taken of
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< mean of the voxels
  double height = 0.0;                                 ///< m, of most voxels: of a table, its top's
  Eigen::AlignedBox3d bounds;                          ///< of the voxels, in A's world
  Obb box;                                             ///< the node's, in A's world, not padded
  VoxelTree tree{{}};
  std::map<std::pair<int, int>, double> heights;  ///< m, the same in squares of the floor

  /// The same of the voxels around a place: tables tilt. Of all of them if there are none.
  [[nodiscard]] double heightNear(const Eigen::Vector2d& xy) const;
};

/// What a whole map says of a place.
enum class Place { unknown, free, occupied };
/// Which voxels are believed to be free.
enum class Trust {
  fine,  ///< those of fine nodes only
  sure,  ///< coarse ones, too, if all their neighbours to the sides are known
  any,   ///< all
};

/// One of the two maps, in A's world.
class MapSide {
 public:
  MapSide(const MapHierarchy& map, const Eigen::Isometry3d& a_T_world, double fine_resolution);

  [[nodiscard]] const std::vector<Thing>& things() const { return things_; }
  /// Index of a node's thing; nothing for the root and for nodes without an occupied voxel.
  [[nodiscard]] std::optional<std::size_t> find(NodeId id) const;

  /// Occupied if some node says so, else free if some node does.
  ///
  /// A coarse voxel (of the background) is free as soon as one beam has grazed it, also at the edge of a
  /// shadow where things are hidden; a thing narrower than two such voxels has no shadow in them at all.
  [[nodiscard]] Place at(const Eigen::Vector3d& p, Trust trust) const;

  /// Whether a node with this label has an occupied voxel in the column from `top` down to `bottom` (m).
  [[nodiscard]] bool surfaceIn(const Label& label, const Eigen::Vector2d& xy, double top,
                               double bottom) const;

 private:
  struct Volume {
    const MapNode* node;
    Eigen::Isometry3d node_T_a;
    Eigen::AlignedBox3d known;  ///< of all that the octree knows, in the node's frame
    Eigen::AlignedBox3d occupied;
  };
  [[nodiscard]] static Place lookUp(const Volume& volume, const Eigen::Vector3d& p);
  [[nodiscard]] bool sidesKnown(const Volume& volume, const Eigen::Vector3d& p) const;

  double fine_resolution_;
  std::vector<Thing> things_;
  std::vector<Volume> volumes_;
};

}  // namespace hoctomap
