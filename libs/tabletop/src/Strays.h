// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "hoctomap/tabletop/TableSearch.h"

namespace hoctomap {

/// Gives points over a table that belong to nothing yet to what they lie on: up to the height of paper to the
/// table, otherwise within the cluster tolerance of an object's point to that object (rims and edges, which
/// are left out of clustering so that they tie nothing together). What is low where half as much that is
/// nobody's lies in a band as thick above it is a wall at the table's edge. In the background, whose voxels
/// are coarse, they would bury the objects (docs/decisions/0007).
void attachStrays(const Measurement& z, std::vector<TableSurface>& tables, std::vector<PointIndices>& objects,
                  const TabletopSegmentationConfig& config);

}  // namespace hoctomap
