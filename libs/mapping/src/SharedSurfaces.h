// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "SurfacePoints.h"
#include "hoctomap/hierarchy/MapHierarchy.h"

namespace hoctomap {

/// Which of the known nodes the segments of a scan show, place by place: each place of a segment belongs to
/// the node whose surface is nearest, within 1 cm and a voxel. Boxes of things that touch or stand on each
/// other meet, their surfaces do not.
class SharedSurfaces {
 public:
  /// @param segments  world points
  /// @param nodes     that these may show
  SharedSurfaces(const MapHierarchy& hierarchy, std::span<const PointCloud* const> segments,
                 std::span<const NodeId> nodes);

  /// The node that has most of a segment, if it is a quarter of it, or if the segment shows half of the node.
  [[nodiscard]] std::optional<NodeId> mainNode(std::size_t segment) const;
  /// Share of a segment that lies at a node's surface.
  [[nodiscard]] double share(std::size_t segment, NodeId node) const;
  /// Nodes beside the main one of which a segment shows most of what the scan shows of them.
  [[nodiscard]] std::vector<NodeId> othersIn(std::size_t segment) const;

  /// Which of `nodes` each point is nearest to, as an index.
  [[nodiscard]] std::vector<std::size_t> nearestOf(const PointCloud& world_points,
                                                   std::span<const NodeId> nodes) const;
  /// The places of a node, and the segment nearest to each within 3 cm, if there is one.
  struct Place {
    Eigen::Vector3f world_point;
    std::optional<std::size_t> segment;
  };
  [[nodiscard]] std::vector<Place> placesOf(NodeId node, std::span<const std::size_t> segments) const;

 private:
  void countShares();

  std::vector<std::unique_ptr<SurfacePoints>> segments_;
  std::map<NodeId, std::unique_ptr<SurfacePoints>> nodes_;
  std::map<NodeId, float> radius_;                             ///< m
  std::vector<std::map<NodeId, std::size_t>> places_at_node_;  ///< of every segment
  std::vector<std::map<NodeId, std::size_t>> places_of_node_;  ///< that every segment shows
  std::map<NodeId, std::size_t> shown_;                        ///< places of a node that some segment shows
};

}  // namespace hoctomap
