// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "hoctomap/exploration/Robot.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/simulation/Scene.h"
#include "hoctomap/simulation/SimulatedRobotConfig.h"

namespace hoctomap {

/// What counts as surface that a robot could see.
struct CoverageConfig {
  double sample_spacing = 0.005;  ///< m between points of the surface
  double place_spacing = 0.1;     ///< m between places that the robot looks from
  double height_spacing = 0.1;    ///< m between the heights of its camera
  double radius = 1.2;            ///< m: how far from the table it looks from
  double max_distance = 2.5;      ///< m from the camera
  double max_incidence = 1.3963;  ///< radians between beam and normal: 80 degrees
};

/// How much of the surface of objects a map holds, measured by the part that a robot can see from *any* place
/// near their table that it can drive to in the true scene: samples of the surface of which one such camera
/// has a free line of sight, whatever it is turned to. What no such camera sees, like the bottom of a cup,
/// does not count.
class SurfaceCoverage {
 public:
  /// The samples of one object.
  struct Object {
    SolidId solid;
    std::string name;
    SolidId table;  ///< it stands on
    std::vector<Eigen::Vector3d> world_visible;
    std::size_t samples = 0;  ///< visible or not
  };
  /// Of one object or more.
  struct Share {
    std::size_t visible = 0;
    std::size_t covered = 0;
    void operator+=(const Share& other) { visible += other.visible, covered += other.covered; }
    /// 1 if nothing is visible.
    [[nodiscard]] double value() const;
  };
  /// In the order of `objects`.
  struct Result {
    std::vector<Share> objects;
    Share all;
  };

  /// Of the objects that are present and stand on tables, in the order of the scene.
  SurfaceCoverage(const Scene& scene, const SimulatedRobotConfig& robot, const CoverageConfig& config = {});

  [[nodiscard]] const std::vector<Object>& objects() const { return objects_; }

  /// A sample is covered if an occupied voxel of a node of an object or table lies within `tolerance` m: one
  /// voxel of the objects. Nodes that wait for confirmation count if they would enter the map now.
  [[nodiscard]] Result of(const MapHierarchy& map, double tolerance) const;
  [[nodiscard]] Share ofTable(const Result& result, SolidId table) const;

 private:
  std::vector<Object> objects_;
};

}  // namespace hoctomap
