// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "hoctomap/tabletop/SurfaceGrid.h"

namespace hoctomap {

/// A table as one scan shows it.
struct TableSurface {
  Plane plane;          ///< world, normal upwards
  SurfaceGrid grid;     ///< around the table
  CellMask patch;       ///< cells in which the surface is seen
  CellMask extent;      ///< its outline: the patch, its holes and what objects hide of it
  PointIndices points;  ///< z_table, ascending

  [[nodiscard]] double area() const {
    return static_cast<double>(count(patch)) * grid.cellSize() * grid.cellSize();
  }
};

/// The tables of a scan, largest first: horizontal planes at table height, one table for each patch of such a
/// plane that is large enough, seen from above, and not the top of something that stands on a larger one. If
/// there is none: the hidden floors of full bins.
[[nodiscard]] std::vector<TableSurface> findTables(const Measurement& z,
                                                   const TabletopSegmentationConfig& config);

}  // namespace hoctomap
