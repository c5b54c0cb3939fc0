// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

#include "hoctomap/existence/BeamExistenceModel.h"
#include "hoctomap/existence/RangeView.h"
#include "hoctomap/mapping/Registration.h"

namespace hoctomap {

/// What a scan says of places in the world.
class ScanSight {
 public:
  /// @param near  m, by which a beam's end may miss a surface, beside three sigma of the noise
  ScanSight(const Measurement& z, double near, const RangeNoise& noise);

  /// Whether it says anything: only a range image shows more than its own points.
  [[nodiscard]] bool hasImage() const { return has_image_; }
  [[nodiscard]] Sight operator()(const Eigen::Vector3f& world_point) const;

 private:
  bool has_image_;
  double near_;
  RangeNoise noise_;
  RangeView view_;
};

}  // namespace hoctomap
