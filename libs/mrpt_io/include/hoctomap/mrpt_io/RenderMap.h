// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// A picture as a sensor would have taken it, but upright.
struct SensorView {
  Pose world_T_sensor;  ///< x forward, y left, z up
  double fov_x = 60.0;  ///< degrees; all of this is in the picture
  double fov_y = 45.0;
};

struct RenderOptions {
  unsigned width = 1600;   ///< pixels
  unsigned height = 1000;  ///< pixels
  std::string view = "oblique";
  std::optional<SensorView> sensor{};  ///< instead of `view`
  bool labels = false;                 ///< also the boxes of the nodes and their labels
  std::set<Label> hidden{};            ///< nodes of these labels are left out
};

/// What `RenderOptions::view` may be, besides `AZIMUTH,ELEVATION` (degrees, of the eye as seen from what is
/// looked at). `oblique`: from above, from the side that was seen, or the
/// next one where little stands in the way.
[[nodiscard]] const std::vector<std::string>& renderViews();

/// Writes a PNG of a map, nodes coloured by label as in Fig. 3 of the paper; tables and objects fill the
/// picture. Needs no display (EGL).
/// @throws ConfigError if the options are wrong; FileError if there is no EGL, or the file cannot be written.
void renderMap(const MapHierarchy& hierarchy, const RenderOptions& options,
               const std::filesystem::path& file);

}  // namespace hoctomap
