// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "hoctomap/config/Settings.h"
#include "hoctomap/mapping/UpdateReport.h"
#include "vi_b/Ghosts.h"

namespace hoctomap {

/// What a picture shows of a map: what lies in a box around the removed object, seen from behind it. That is
/// the side where the cells are that the sensor cannot see into.
struct PictureFrame {
  Eigen::AlignedBox3d box;  ///< world
  double azimuth = 0.0;     ///< degrees, of the eye seen from the box
};

/// What is less than 0.18 m from the removed object, and as high as the objects of `now` beside it.
[[nodiscard]] PictureFrame frameAround(const RemovedNode& gone, const MapHierarchy& now,
                                       const Eigen::Vector3d& sensor);

/// Cuts the part of a map that lies in the frame out as a map directory of its own (`hoctomap render` shows
/// maps as a whole) and renders it: `<file>.png`, and beside it the folder `<file>_cut`. Ghosts become a node
/// labelled `ghost`, which has its own colour; a single map becomes a node under an empty root, so that it
/// fills the picture.
void renderCut(const MapHierarchy& map, const PointCloud& ghosts, const PictureFrame& frame,
               const Settings& settings, const std::filesystem::path& file);

}  // namespace hoctomap
