// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "hoctomap/simulation/Simulation.h"
#include "hoctomap/simulation/VisibleSurface.h"

namespace hoctomap {

/// Writes the truth of a simulated log into a folder:
///
/// - `labels/KKKKKK.png`: 16 bit, `SimulatedScan::labels` of scan K.
/// - `objects.csv`: `value,object,label`: what the values of the images stand for.
/// - `poses.csv`: one line a scan and table or object; metres, degrees, world frame:
///   `scan,object,label,present,visible_pixels`, pose `x,y,z,yaw,pitch,roll`, whole surface: centroid
///   `cx,cy,cz` and half extents `hx,hy,hz` of the box along the world axes around it, its centre `bx,by,bz`;
///   part of the surface seen until this scan, at 2 mm: number `seen_voxels` and centroid `sx,sy,sz` (empty
///   if unseen); `value` of the images.
class TruthWriter {
 public:
  /// Makes the folder. Files of the same names are replaced.
  /// @throws FileError if a folder or file cannot be made.
  TruthWriter(const std::filesystem::path& folder, const Scene& scene);

  /// @throws FileError
  void write(const SimulatedScan& scan);

  /// Completes the CSV. Without this call the truth is incomplete.
  /// @throws FileError
  void finish();

 private:
  std::filesystem::path folder_;
  VisibleSurface seen_;
  std::string poses_;

  void appendPose(const SimulatedScan& scan, SolidId id);
};

}  // namespace hoctomap
