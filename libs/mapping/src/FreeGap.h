// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "ScanSight.h"

namespace hoctomap {

/// Whether a scan sees through between two parts of a surface (points in the world), so that they are two
/// things: all along a line between points of them that are as near as any, to 1 cm, and above the others.
/// What hides behind a thing is not seen through, so that the sides of one have no gap. Parts within 4 cm of
/// each other may be one whose connection is too thin to be seen.
[[nodiscard]] bool hasFreeGap(const ScanSight& sight, const PointCloud& a, const PointCloud& b);

}  // namespace hoctomap
