// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/exploration/Viewpoint.h"
#include "hoctomap/hierarchy/NodeId.h"

namespace hoctomap {

class TraversabilityMap;

/// What a step of the exploration did.
enum class StepKind : std::uint8_t {
  look_around,  ///< from where the robot stood at the start
  first_view,   ///< of a table: to find its objects
  view,         ///< of a table, for what its objects hide
  move_failed,  ///< nothing was measured
  explored,     ///< the table is done: no viewpoint was worth it
  unreachable,  ///< no place from which the table can be seen can be reached
  out_of_views  ///< the table has had its number of views
};
[[nodiscard]] std::string toString(StepKind kind);

/// One turn of the loop of Algorithm 1.
struct ExplorationStep {
  struct Candidate {
    Viewpoint viewpoint;
    double gain = 0.0;  ///< bits or cells, see GainMeasure
    double cost = 0.0;  ///< s
    double utility = 0.0;
  };

  std::uint64_t step = 0;
  StepKind kind = StepKind::look_around;
  std::optional<NodeId> table;                        ///< none while looking around
  std::optional<std::uint64_t> scan;                  ///< number of the measurement that was taken
  std::vector<Candidate> candidates;                  ///< V
  std::optional<std::size_t> chosen;                  ///< v*, of the candidates
  std::vector<Eigen::Vector2d> path;                  ///< to it
  double travel = 0.0;                                ///< m, of this step
  double entropy = 0.0;                               ///< bits, of the space over the table before the step
  std::size_t unknown_in_boxes = 0;                   ///< cells, before the step
  const TraversabilityMap* traversability = nullptr;  ///< m_trav, during the call; none while looking around

  [[nodiscard]] double mostGain() const;
  /// Chooses v*, the most useful one (Eq. 16) of the candidates whose gain exceeds `least`, if there is one.
  /// The best of all may be near, and yet a useless trip.
  void choose(double least);
};

}  // namespace hoctomap
