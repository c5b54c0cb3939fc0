// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>

#include "Lanes.h"
#include "VoxelBits.h"

namespace hoctomap::engine {

/// Where endpoints are marked.
struct EndpointField {
  EndpointField(const VoxelGrid& grid, const Eigen::Vector3f& origin, double max_range, const KeyBox& box,
                const BlockFrame& frame);

  double cells_per_metre;
  std::array<double, 3> to_local;  ///< from cells counted from zero to local coordinates
  std::array<double, 3> first;     ///< local coordinates of the box
  std::array<double, 3> last;
  std::array<float, 3> origin;  ///< metres
  double max_range;             ///< metres; negative: none
};

/// Marks the voxels of the endpoints that lie in the box and within the range.
using MarkEndpoints = void (*)(const EndpointField&, std::span<const Eigen::Vector3f> points, VoxelBits&);
[[nodiscard]] MarkEndpoints chooseMarkEndpoints(InstructionSet set);

}  // namespace hoctomap::engine
