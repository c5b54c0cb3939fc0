// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <octomap/OcTree.h>

#include <optional>
#include <utility>

namespace hoctomap::engine {

/// Least and greatest key of the occupied voxels along each axis; none without any. Enters only what may lie
/// farther out than what is found, the outermost branches first.
[[nodiscard]] std::optional<std::pair<octomap::OcTreeKey, octomap::OcTreeKey>> occupiedCorners(
    const octomap::OcTree& tree);

}  // namespace hoctomap::engine
