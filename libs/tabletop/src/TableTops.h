// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ScanBlocks.h"
#include "hoctomap/tabletop/TableSearch.h"

namespace hoctomap {

inline constexpr double kSameTable = 0.03;  // m between a table's plane and surfels that are its own residue

/// Leaves only tables that stand on their own, largest first: not the top of a box or of a pile of books on
/// another table, nor what noise left of a larger one.
/// (docs/decisions/0031).
void keepTables(const ScanBlocks& scan, std::vector<TableSurface>& tables,
                const TabletopSegmentationConfig& config);

}  // namespace hoctomap
