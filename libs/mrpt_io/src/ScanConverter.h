// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "hoctomap/geometry/Measurement.h"

namespace hoctomap {

/// A scan that cannot be used, and why: one of few texts.
struct Unusable {
  std::string reason;
};

/// @throws LimitError if a scan has more than 10^7 points
void checkPoints(std::size_t count);

/// What the sensor saw, in its own frame (x forward, y left, z up).
using SensorScan = std::variant<DepthImage, PointCloud, Unusable>;

/// Whether observations of this class are 3D scans (they are counted as scans even when one is damaged).
[[nodiscard]] bool isScan(const mrpt::obs::CObservation& observation);

/// Size of the range image, {0, 0} if there is none or it is stored outside the log.
[[nodiscard]] std::pair<std::uint32_t, std::uint32_t> imageSize(const mrpt::obs::CObservation& observation);

/// The files with points or ranges that the observation stores outside of the log, as it names them.
[[nodiscard]] std::vector<std::string> externalNames(const mrpt::obs::CObservation& observation);

/// The returns of one observation; external files are read from `images_folder` and nowhere else.
/// @throws InputError if an external file lies outside of the folder, LimitError beyond 10^7 points.
[[nodiscard]] SensorScan convertScan(mrpt::obs::CObservation& observation,
                                     const std::filesystem::path& images_folder);

/// What the user should know of scans like this one, once a sensor; empty if nothing.
[[nodiscard]] std::string remarkOn(const mrpt::obs::CObservation& observation);

}  // namespace hoctomap
