// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A table of the map as an area of interest (Section V): where it is, and the space in which objects may
/// stand on it.
struct TableArea {
  NodeId node;
  double top = 0.0;  ///< m, world z of its upper face
  std::vector<Eigen::Vector2d>
      outline;                ///< world x, y: centres of the cells of `kOutlineCell` that it covers
  Eigen::Vector2d center;     ///< of the outline's bounding box
  Eigen::AlignedBox3d space;  ///< world: outline grown by a margin, from below the face upwards

  /// Distance of a place on the floor from the outline, m; 0 inside.
  [[nodiscard]] double distanceTo(const Eigen::Vector2d& place) const;
};

inline constexpr double kOutlineCell = 0.05;  ///< m

/// How far around a table its objects may reach.
struct TableSpace {
  double margin = 0.03;  ///< m beyond the outline
  double height = 0.3;   ///< m above the face, at least; higher where its objects are
};

/// The area of a node, or nothing if it has no occupied voxels.
[[nodiscard]] std::optional<TableArea> tableArea(const MapHierarchy& map, NodeId table,
                                                 const TableSpace& space);

/// All tables of the map that are confirmed, by id.
[[nodiscard]] std::vector<TableArea> tableAreas(const MapHierarchy& map, const TableSpace& space);

}  // namespace hoctomap
