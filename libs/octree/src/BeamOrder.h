// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "MarkedReach.h"
#include "ScanBeams.h"

namespace hoctomap::engine {

/// Where a beam ends, and where it goes.
struct AimedBeam {
  Eigen::Vector3f end;
  Direction direction;
};

/// True if the beams are so many, so long and so close together that most of the voxels that a beam meets
/// have been met by others: looked up in a sample.
bool isDense(const ScanBeams& scan, std::span<const Eigen::Vector3f> points);

/// The beams to these points by direction. Those that end at the origin, or nowhere, are left out: they mark
/// nothing.
std::vector<AimedBeam> orderByDirection(const ScanBeams& scan, std::span<const Eigen::Vector3f> points);

}  // namespace hoctomap::engine
