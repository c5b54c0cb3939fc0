// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "ScanBlocks.h"
#include "hoctomap/tabletop/TableSearch.h"

namespace hoctomap {

/// Bins so full that their floor is not seen, in a scan that shows no table: known by their rim, a horizontal
/// strip at table height around cells through which beams pass. What lies in a bin stands on its floor, which
/// is taken to be as low as the lowest of what is seen in it.
[[nodiscard]] std::vector<TableSurface> findBins(const ScanBlocks& scan,
                                                 const TabletopSegmentationConfig& config);

}  // namespace hoctomap
