// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "Vessels.h"

namespace hoctomap {

/// Joins to each cluster the much smaller ones that lie within its box (upright, turned to its principal axes
/// in the plan): what shows behind a rim, for solid things do not share their space; and those that it holds
/// up from the side: handles.
void joinEnclosedPieces(std::vector<Cluster>& clusters, const Measurement& z);

}  // namespace hoctomap
