// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include "hoctomap/existence/ExistenceFilter.h"
#include "hoctomap/geometry/Measurement.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// What one measurement says of one node: beams that should meet its occupied voxels, by where they end.
struct Evidence {
  std::uint32_t present = 0;   ///< they end on the node
  std::uint32_t absent = 0;    ///< they end beyond it
  std::uint32_t occluded = 0;  ///< they end before it
  bool informative = false;    ///< enough beams to say anything; otherwise P(n | z_t) = P(n)
  double p_measurement = 0.5;  ///< P(n | z_t)
  /// m in the world: how far off the node the beams are that fit it best. An error of the scan's pose shifts
  /// all that it shows; what is shifted otherwise has moved.
  Eigen::Vector3d shift = Eigen::Vector3d::Zero();
  bool in_sight = false;  ///< enough beams get to its place, whether or not they can say anything

  /// Share of the beams that reach the node's place that end on the node; 0 if none do.
  [[nodiscard]] double presentShare() const {
    return present == 0 ? 0.0 : static_cast<double>(present) / (static_cast<double>(present) + absent);
  }
  /// Whether the measurement contradicts the node: it takes no segment of this scan.
  [[nodiscard]] bool contradicts() const { return informative && 2 * present < present + absent; }
};

/// A node that a measurement is asked about.
struct NodeInQuestion {
  NodeId id;
  ExistenceParameters parameters;
  /// All that is in its map was measured from the place where the sensor is now: no error of poses lies
  /// between.
  bool same_view = false;
};

/// P(n | z_t), specific to the sensor and the segmentation (Section III-D).
class InverseExistenceModel {
 public:
  virtual ~InverseExistenceModel() = default;

  /// Evidence for each of `nodes`, in their order, from the whole measurement, taken before anything of it is
  /// integrated.
  [[nodiscard]] virtual std::vector<Evidence> evidence(const MapHierarchy& hierarchy,
                                                       const Measurement& measurement,
                                                       const std::vector<NodeInQuestion>& nodes) const = 0;

  /// Box in the world that a node must meet to get any evidence from this measurement: so that the work grows
  /// with the nodes in view and not with all nodes.
  [[nodiscard]] virtual Eigen::AlignedBox3d reach(const Measurement& measurement) const;
};

}  // namespace hoctomap
