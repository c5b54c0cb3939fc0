// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <vector>

#include "hoctomap/exploration/ClearedSpace.h"
#include "hoctomap/exploration/Explorer.h"
#include "hoctomap/exploration/KnowledgeGrid.h"
#include "hoctomap/simulation/SceneRaycaster.h"
#include "hoctomap/simulation/Simulation.h"
#include "vi_c/Trial.h"

namespace hoctomap {

/// What the candidates of a step would really have found: for each a depth image of the true scene (160 x
/// 120, without faults), and the cells unknown in boxes that it shows, being free or the surface itself.
class GainTruth {
 public:
  GainTruth(const Simulation& simulation, const ExplorationConfig& config);

  /// Keeps what a measurement clears.
  void add(const Measurement& z);
  /// Takes down what is known of a table now: before the next step.
  void look(const MapHierarchy& map, NodeId table);
  /// Of a step of the table that was last looked at; otherwise empty.
  [[nodiscard]] std::vector<GainCheck> check(const ExplorationStep& step) const;

 private:
  [[nodiscard]] double cellsShown(const Viewpoint& viewpoint) const;

  const ExplorationConfig& config_;
  PinholeCamera camera_;
  double min_range_;
  double max_range_;
  double planned_range_;
  SceneRaycaster scene_;
  struct Scan {
    Eigen::Vector3f origin;
    PointCloud world_points;
  };
  std::vector<Scan> scans_;
  std::optional<NodeId> table_;
  std::optional<ClearedSpace> cleared_;
  std::size_t cleared_scans_ = 0;
  std::vector<Eigen::Vector3d> unknown_;  ///< centres of the cells, world
  double cell_ = 0.0;
};

}  // namespace hoctomap
