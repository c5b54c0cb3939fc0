// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/mapping/Registration.h"

namespace hoctomap {

/// What became of a thing between two maps of one place.
enum class ChangeKind {
  added,         ///< in B only, and A saw that its place was empty or held something else
  removed,       ///< in A only, and B saw that
  moved,         ///< the same shape in another place
  changed,       ///< in the same place with another shape
  unobservable,  ///< in one map only, and the other did not see the place
};
[[nodiscard]] std::string toString(ChangeKind kind);

/// One difference. A thing is in `node_a`, `node_b` or both.
struct Change {
  ChangeKind kind = ChangeKind::changed;
  std::optional<NodeId> node_a;
  std::optional<NodeId> node_b;
  Label label;
  /// Mean of the occupied voxels in A's world, m: where A has the thing, else where B has it.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  /// Of what moved, in A's world: p_in_b = motion * p_in_a. Otherwise the identity.
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  /// In [0, 1]. moved: overlap after the motion; changed: overlap in place (both: the smaller one of the two
  /// ways); otherwise the share of the place that the other map saw.
  double score = 0.0;
  /// Nodes of A and of B that came along with what moved: a table's objects. They are no changes of their
  /// own.
  std::vector<std::pair<NodeId, NodeId>> carried;
  /// What was not decided: why, and with which nodes.
  std::string detail;
};

struct DiffConfig {
  double near = 0.006;            ///< m; surfaces nearer than this, plus half a voxel of each map, are one
  double same_overlap = 0.75;     ///< a thing is in the other map if that share of what can be compared is
  double least_overlap = 0.5;     ///< below it the other thing in its place is another one, not a changed one
  double clear_overlap = 0.9;     ///< above it nobody asks for a motion
  double seen_share = 0.3;        ///< share of a thing's place that must be seen to call it added or removed
  double seen_for_motion = 0.25;  ///< share of the old and of the new place that must be seen for a motion
  double min_motion = 0.025;      ///< m; smaller shifts are errors of the poses
  double min_turn = 0.14;         ///< rad; the same for turns
  double fine_resolution = 0.02;  ///< m; coarser voxels are free for a thing only with their neighbours
  double rival_score = 0.05;      ///< another thing that fits that nearly as well makes a motion ambiguous
  RegistrationConfig registration;
};

/// What changed from `a` to `b`. @param a_T_b takes coordinates in B's world frame to A's.
///
/// Properties:
///  1. diff(A, A) is empty;
///  2. diff(B, A) mirrors diff(A, B): added and removed swap, motions are inverted;
///  3. nothing is reported for want of sight: unknown space contradicts nothing;
///  4. the resolutions of the maps and their frames do not matter beyond the voxels' size;
///  5. every node but the roots is in at most one change; the roots (background) are only looked at for
///     what they saw.
/// In order of kind, then of the nodes.
[[nodiscard]] std::vector<Change> diff(const MapHierarchy& a, const MapHierarchy& b, const DiffConfig& config,
                                       const Eigen::Isometry3d& a_T_b = Eigen::Isometry3d::Identity());

}  // namespace hoctomap
