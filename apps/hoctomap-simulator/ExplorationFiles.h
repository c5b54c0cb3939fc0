// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "hoctomap/exploration/Explorer.h"
#include "hoctomap/simulation/SurfaceCoverage.h"

namespace hoctomap {

/// The rows of `exploration.csv`, one a step.
class ExplorationTable {
 public:
  explicit ExplorationTable(const RobotModel& robot) : robot_(robot) {}

  /// @param coverage after the step, if the truth is known
  void add(const ExplorationStep& step, const std::optional<double>& coverage);
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  RobotModel robot_;
  double travel_ = 0.0;   ///< m, of all steps so far
  double seconds_ = 0.0;  ///< of driving and measuring so far
  std::string text_ =
      "step,kind,table,scan,candidates,gain,cost_s,utility,x,y,yaw_deg,sensor_height,tilt_deg,"
      "entropy_bits,unknown_cells,coverage,travel_m,total_travel_m,total_s\n";
};

/// Writes the map as a picture that MRPT's `COccupancyGridMap2D::loadFromBitmapFile` takes, and ROS's
/// map_server: white where the robot can stand with its centre, black where it would hit something, grey
/// where nothing is known. FILE.png, and FILE.yaml with resolution and origin. @throws FileError
void writeTraversability(const TraversabilityMap& map, const std::filesystem::path& file_without_extension);

/// What is held of each object's surface, as CSV. @param result of `coverage`
[[nodiscard]] std::string coverageCsv(const Scene& scene, const SurfaceCoverage& coverage,
                                      const SurfaceCoverage::Result& result);

}  // namespace hoctomap
