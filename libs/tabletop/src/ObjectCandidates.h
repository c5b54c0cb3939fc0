// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/tabletop/TableSearch.h"

namespace hoctomap {

/// A point near a table and not part of its surface.
struct Candidate {
  std::uint32_t point = 0;
  std::size_t cell = 0;  ///< of the table's grid, under the point
  double height = 0.0;   ///< m above the table
  double range = 0.0;    ///< m from the sensor
  double least_rise =
      0.0;  ///< m above the table that are evidence there, see `leastRise`; of points near the table
};

/// Regions of a table's grid, from the inside to the outside.
struct Regions {
  explicit Regions(const TableSurface& table);

  CellMask contact;  ///< where an object's foot may touch
  CellMask inside;   ///< where its points may be
  CellMask around;   ///< where they are followed
};

/// The points from which the objects on a table are clustered, ascending: those above it, and, so that what
/// only passes by is known for what it is, those around and below its edge. Without the points in `taken` and
/// flying pixels.
[[nodiscard]] std::vector<Candidate> objectCandidates(const ScanBlocks& scan, const TableSurface& table,
                                                      const Regions& regions, const std::vector<bool>& taken,
                                                      const TabletopSegmentationConfig& config);

/// Drops layers that are low and broad. A sheet of paper is no object, and must not tie a mug to the
/// magazines beside it.
void dropFlatLayers(const TableSurface& table, std::vector<Candidate>& candidates,
                    const TabletopSegmentationConfig& config);

/// The distance that joins two candidates. More than `cluster_tolerance` where the sensor scatters a surface
/// so much that it would fall apart.
[[nodiscard]] double clusterTolerance(std::vector<Candidate> candidates,
                                      const TabletopSegmentationConfig& config);

}  // namespace hoctomap
