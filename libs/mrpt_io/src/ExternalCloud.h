// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationPointCloud.h>

#include <filesystem>
#include <optional>

#include "hoctomap/geometry/PointCloud.h"

namespace hoctomap {

/// The points of a cloud from the file that MRPT keeps them in beside a log: one of its map objects (plain or
/// gzip), records of four floats (KITTI's), or lines of text with three numbers or more. MRPT's own loader
/// takes a map's counts as they are, and what is missing from a file that was cut for its end.
/// @param cloud its file exists
/// @return nothing if the file is not whole
/// @throws LimitError if it holds more than 10^7 points, or inflates beyond the budgets of a log
[[nodiscard]] std::optional<PointCloud> readExternalCloud(const mrpt::obs::CObservationPointCloud& cloud,
                                                          const std::filesystem::path& folder);

}  // namespace hoctomap
