// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/InverseExistenceModel.h"

#include <limits>

namespace hoctomap {

Eigen::AlignedBox3d InverseExistenceModel::reach(const Measurement&) const {
  const Eigen::Vector3d far = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  return {-far, far};
}

}  // namespace hoctomap
