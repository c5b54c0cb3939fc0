// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/config/Settings.h"
#include "hoctomap/mapping/HierarchyMapper.h"

namespace hoctomap {

/// The segmentation S that the settings name.
[[nodiscard]] std::unique_ptr<Segmentation> makeSegmentation(const Settings& settings);

/// The tabletop strategies of Section IV, or S(z) = {z} for the monolithic map.
[[nodiscard]] MappingStrategies makeStrategies(const Settings& settings);

}  // namespace hoctomap
