// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>

#include "hoctomap/existence/InverseExistenceModel.h"

namespace hoctomap {

/// How far a scan shows all off its place, m in the world, by the nodes of one label that nearly all beams
/// end on, `except` left out: the error of its pose. The median of each coordinate, so that one that has
/// moved does not matter. Nothing if there are fewer than `least_others` such nodes. Tables say little: a
/// plane slides along itself.
/// @param support        evidence by node
/// @param least_present  share of a node's beams
[[nodiscard]] std::optional<Eigen::Vector3d> commonShift(const MapHierarchy& hierarchy,
                                                         const std::map<NodeId, Evidence>& support,
                                                         NodeId except, double least_present,
                                                         std::size_t least_others = 1);

}  // namespace hoctomap
