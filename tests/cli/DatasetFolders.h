// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

#include "Program.h"
#include "hoctomap/geometry/Measurement.h"

namespace hoctomap::test {

/// The camera of the folders below.
inline const PinholeCamera kSmallCamera{16, 12, 15.0, 15.5, 8.0, 6.25};

/// Where the optical frame of a camera is that turns and moves with constant speed.
Pose worldTOptical(double stamp);

/// Depth of pixel `i` of frame `k`, in steps: a smooth surface with a hole.
std::uint16_t depthSteps(std::size_t k, std::size_t i);

/// One row of a TUM trajectory.
std::string tumRow(double stamp, const Pose& pose);

/// A TUM RGB-D folder of `frames` frames at 10 Hz from second 100, with a trajectory at 40 Hz of another
/// phase that begins before the first frame and ends after the last one.
void writeTumFolder(const std::string& folder, std::size_t frames);

/// The same frames as `NAME.depth.png`, `NAME.pose.txt` and `camera-intrinsics.txt`.
void writeFramesFolder(const std::string& folder, std::size_t frames);

}  // namespace hoctomap::test
