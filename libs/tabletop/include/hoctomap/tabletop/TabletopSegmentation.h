// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/mapping/Segmentation.h"
#include "hoctomap/tabletop/TabletopConfig.h"

namespace hoctomap {

/// S' of Eq. 9: horizontal planes at table height, the clusters above them, and the rest.
class TabletopSegmentation : public Segmentation {
 public:
  explicit TabletopSegmentation(const TabletopSegmentationConfig& config) : config_(config) {}
  [[nodiscard]] std::vector<Segment> segment(const Measurement& z) const override;

 private:
  TabletopSegmentationConfig config_;
};

}  // namespace hoctomap
