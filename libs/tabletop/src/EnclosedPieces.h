// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "Vessels.h"

namespace hoctomap {

/// Joins to each cluster the much smaller ones that lie within its box (upright, turned to its principal axes
/// in the plan): handles, and what shows behind a rim. Solid things do not share their space.
void joinEnclosedPieces(std::vector<Cluster>& clusters, const Measurement& z);

}  // namespace hoctomap
