// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "TableRelief.h"
#include "Vessels.h"

namespace hoctomap {

/// The things among the candidates of a table, cut at concave creases and steps (ConvexPatches.h), and with
/// what they enclose, even if the noise of the table's plane holds it, as long as it is not the table. Points
/// ascend within a cluster. `taken` are the points of objects found before; none of these is in a cluster.
[[nodiscard]] std::vector<Cluster> patchClusters(const Measurement& z, const TableSurface& table,
                                                 const TableRelief& relief,
                                                 const std::vector<Candidate>& candidates,
                                                 const std::vector<bool>& taken,
                                                 const TabletopSegmentationConfig& config);

}  // namespace hoctomap
