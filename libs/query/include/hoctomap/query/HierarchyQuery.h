// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "hoctomap/hierarchy/NodeSource.h"

namespace hoctomap {

enum class Occupancy { unknown, free, occupied };

/// What a hierarchy says of a point.
struct PointAnswer {
  Occupancy state = Occupancy::unknown;
  /// P(occupied) = 1/2 + P(n) (P(occupied | n) - 1/2): what the voxel says if the node exists, else nothing.
  double probability = 0.5;
  std::optional<NodeId> node;  ///< that decides; none if the point is unknown
};

struct RayOptions {
  double max_range = std::numeric_limits<double>::infinity();  ///< m
  bool ignore_unknown = false;  ///< as in octomap's castRay: go on through what is unknown
};

/// Where a ray ends.
struct RayAnswer {
  enum class End { hit, unknown, nothing };
  End end = End::nothing;  ///< nothing: max_range, or the end of all that is known
  double distance = 0.0;   ///< m from the origin to `point`; of End::nothing: max_range
  Eigen::Vector3d point =
      Eigen::Vector3d::Zero();  ///< world: where the ray enters what is occupied (unknown)
  std::optional<NodeId> node;   ///< of a hit
};

/// The occupied voxel nearest to a point.
struct NearestVoxel {
  double distance = 0.0;  ///< m to its surface; 0 inside
  Eigen::Vector3d point;  ///< world, its point that is nearest
  NodeId node;
};

/// A node in a region.
struct NodeInRegion {
  NodeId node;
  double share = 0.0;  ///< of its occupied voxels, those whose centre lies in the region
  Label label{};
  double existence = 0.5;
};

struct QueryConfig {
  double min_existence = 0.0;  ///< nodes that exist with a lower probability are left out
};

/// Questions to a whole hierarchy at once (docs/decisions/0040). Everything is in the world frame, in metres.
///
/// Of several nodes that know a place the finer one decides; of equally fine ones the deeper one, then the
/// lower id. Points, rays and unknown shares go by that. Collisions, distances and regions are asked for the
/// sake of safety: every occupied voxel of every node counts, with its whole cube.
///
/// A hierarchy in memory has to outlive it unchanged. Of other sources octrees are asked for when a question
/// touches their node first; what that throws, the question throws. Its functions may run in any number of
/// threads at once. Coordinates have to be finite.
class HierarchyQuery {
 public:
  explicit HierarchyQuery(const MapHierarchy& map, const QueryConfig& config = {});
  explicit HierarchyQuery(std::shared_ptr<const NodeSource> source, const QueryConfig& config = {});
  ~HierarchyQuery();
  HierarchyQuery(HierarchyQuery&&) noexcept;
  HierarchyQuery& operator=(HierarchyQuery&&) noexcept;

  [[nodiscard]] PointAnswer at(const Eigen::Vector3d& world_point) const;
  /// @throws std::invalid_argument unless there are as many answers as points.
  void at(std::span<const Eigen::Vector3d> world_points, std::span<PointAnswer> answers) const;

  /// The first occupied place along a ray. An origin that is occupied is one, at distance 0.
  /// @param direction of any length  @throws std::invalid_argument if it is zero or not finite.
  [[nodiscard]] RayAnswer castRay(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                                  const RayOptions& options = {}) const;

  /// The finest node that has an occupied voxel which shares a point with the box; nothing if there is none.
  [[nodiscard]] std::optional<NodeId> collision(const Obb& box) const;
  /// The same for a sphere; `radius` >= 0, m.
  [[nodiscard]] std::optional<NodeId> collision(const Eigen::Vector3d& centre, double radius) const;

  /// The nearest occupied voxel not further away than `max_distance`; of equally near ones the finest.
  [[nodiscard]] std::optional<NearestVoxel> nearestOccupied(
      const Eigen::Vector3d& world_point,
      double max_distance = std::numeric_limits<double>::infinity()) const;

  /// Share of the box's volume that no node knows, in [0, 1], by a regular grid of points: the centres of
  /// cells with edges of at most `step` (m; 0: the finest resolution of the nodes there), at most 100 along
  /// an edge.
  [[nodiscard]] double unknownShare(const Obb& box, double step = 0.0) const;

  /// The nodes, root excepted, that have an occupied voxel which shares a point with the region; by id.
  [[nodiscard]] std::vector<NodeInRegion> nodesIn(const Obb& region) const;

 private:
  class Nodes;
  std::unique_ptr<const Nodes> nodes_;
};

}  // namespace hoctomap
