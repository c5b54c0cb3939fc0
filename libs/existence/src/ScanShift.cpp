// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/ScanShift.h"

#include <algorithm>
#include <array>
#include <vector>

namespace hoctomap {

std::optional<Eigen::Vector3d> commonShift(const MapHierarchy& hierarchy,
                                           const std::map<NodeId, Evidence>& support, NodeId except,
                                           double least_present, std::size_t least_others) {
  const Label& label = hierarchy.node(except).label();
  std::array<std::vector<double>, 3> shifts;
  for (const auto& [id, evidence] : support) {
    if (id == except || !evidence.informative || evidence.presentShare() < least_present) continue;
    if (hierarchy.node(id).label() != label) continue;
    for (std::size_t axis = 0; axis < 3; ++axis)
      shifts[axis].push_back(evidence.shift[static_cast<Eigen::Index>(axis)]);
  }
  if (shifts[0].size() < std::max<std::size_t>(1, least_others)) return std::nullopt;
  Eigen::Vector3d common;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::sort(shifts[axis].begin(), shifts[axis].end());
    const std::size_t n = shifts[axis].size();
    common[static_cast<Eigen::Index>(axis)] = 0.5 * (shifts[axis][(n - 1) / 2] + shifts[axis][n / 2]);
  }
  return common;
}

}  // namespace hoctomap
