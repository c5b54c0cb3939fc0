// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <memory>
#include <vector>

#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/octree/ScanUpdate.h"

namespace hoctomap {

/// A scan as OctoMap takes it.
struct StockScan {
  octomap::Pointcloud points;
  octomap::point3d origin;
};

[[nodiscard]] StockScan toStock(const Measurement& z);

/// The baseline of a whole scan: OctoMap's own insertPointCloud, neither lazy nor discretized.
void insertStock(octomap::OcTree& tree, const StockScan& scan, double max_range);

/// The baseline of a node in its box, with OctoMap's own functions: computeUpdate gives the key sets of the
/// scan, the free keys outside the box are dropped, and updateNode is called for each of the others.
///
/// `makeReferenceScanUpdate` drops them already while it walks along the beams, which is much faster: what
/// somebody would do who wants to be fast with OctoMap.
[[nodiscard]] std::unique_ptr<ScanUpdate> makeStockBoxUpdate();

/// What a scan means for a tree, as OctoMap goes about it.
struct ScanCells {
  std::size_t visits = 0;   ///< cells on all beams
  std::size_t updates = 0;  ///< distinct cells: calls of updateNode
};
[[nodiscard]] ScanCells countCells(const octomap::OcTree& tree, const StockScan& scan, double max_range);

}  // namespace hoctomap
