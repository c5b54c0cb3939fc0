// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/query/HierarchyDiff.h"

#include "Differ.h"

namespace hoctomap {

std::vector<Change> diff(const MapHierarchy& a, const MapHierarchy& b, const DiffConfig& config,
                         const Eigen::Isometry3d& a_T_b) {
  Differ differ(a, b, config, a_T_b);
  differ.compareInPlace();
  differ.findShifted();
  differ.findMovedElsewhere();
  differ.carryChildren();
  differ.findReshaped();
  differ.reportRest();
  return differ.changes();
}

std::string toString(ChangeKind kind) {
  switch (kind) {
    case ChangeKind::added:
      return "added";
    case ChangeKind::removed:
      return "removed";
    case ChangeKind::moved:
      return "moved";
    case ChangeKind::changed:
      return "changed";
    case ChangeKind::unobservable:
      return "unobservable";
  }
  return "unknown";
}

}  // namespace hoctomap
