// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "Program.h"
#include "hoctomap/io/Manifest.h"
#include "hoctomap/mapping/MeasurementSource.h"

namespace hoctomap::test {

/// Path of a scene of configs/scenes.
std::string scene(const std::string& name);

/// Makes LOG (and its truth) of a scene of configs/scenes. Fails the test if that fails.
void simulate(const std::string& scene_name, const std::string& log,
              const std::vector<std::string>& settings = {});

/// Builds a map; fails the test unless the exit code is `expected`.
Outcome build(const std::string& log, const std::string& map, const std::vector<std::string>& more = {},
              int expected = 0);

/// The depth scans of a log, with their points in the world.
std::vector<Measurement> scansOf(const std::string& log);

/// Writes the depth scans of a log in reverse order, at the times of the original.
void reverseLog(const std::string& log, const std::string& reversed);

/// Writes the depth scans of a log and a movement behind them.
void copyLog(const std::string& log, const std::string& copy, const ObjectMotion& end);

/// Writes the depth scans of a log with errors added to their poses, normally distributed along and about
/// each axis: metres, degrees.
void addPoseNoise(const std::string& log, const std::string& noisy, double shift, double turn,
                  std::uint64_t seed);

/// A node as the tests look at it.
struct MappedNode {
  NodeRecord record;
  Eigen::Vector3d centroid;  ///< of the occupied voxels, in the world
  PointCloud world_voxels;   ///< centres of the occupied ones
};

/// Where a scan shows a surface.
class ShownPlaces {
 public:
  explicit ShownPlaces(const PointCloud& world_points);
  /// Whether there is a point within two to four centimetres.
  [[nodiscard]] bool isNear(const Eigen::Vector3f& world_point) const;

 private:
  std::set<std::array<int, 3>> cells_;  ///< of 2 cm
};

/// The nodes of a map with this label.
std::vector<MappedNode> nodesOf(const std::string& map, const std::string& label);

/// Compares the objects of a map with the truth that `simulate` wrote for the last scan: each is exactly one
/// node, within `tolerance` metres of what the sensor has seen of it, below the table it stands on.
void expectTruth(const std::string& map, const std::string& truth, double tolerance);

}  // namespace hoctomap::test
