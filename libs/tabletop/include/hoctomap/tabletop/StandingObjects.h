// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "hoctomap/tabletop/TableSearch.h"

namespace hoctomap {

/// The objects z_obj that stand on the tables of a scan, largest first: clusters of points above a table that
/// touch its surface, do not go on below it, and do not reach far beyond it.
[[nodiscard]] std::vector<PointIndices> findStandingObjects(const Measurement& z,
                                                            std::span<const TableSurface> tables,
                                                            const TabletopSegmentationConfig& config);

}  // namespace hoctomap
