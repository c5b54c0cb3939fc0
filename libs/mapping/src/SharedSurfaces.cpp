// SPDX-License-Identifier: BSD-3-Clause
#include "SharedSurfaces.h"

#include <algorithm>
#include <limits>

namespace hoctomap {

namespace {

constexpr float kSpacing = 0.004F;  // m, between the places that are compared
constexpr float kNear = 0.01F;      // m, beside a voxel: views drift apart

}  // namespace

SharedSurfaces::SharedSurfaces(const MapHierarchy& hierarchy, std::span<const PointCloud* const> segments,
                               std::span<const NodeId> nodes) {
  for (const PointCloud* points : segments)
    segments_.push_back(std::make_unique<SurfacePoints>(*points, kSpacing));
  for (const NodeId id : nodes) {
    nodes_[id] = std::make_unique<SurfacePoints>(worldSurface(hierarchy, id), kSpacing);
    radius_[id] = kNear + static_cast<float>(hierarchy.node(id).map().resolution());
  }
  countShares();
}

void SharedSurfaces::countShares() {
  places_at_node_.resize(segments_.size());
  places_of_node_.resize(segments_.size());
  for (std::size_t s = 0; s < segments_.size(); ++s) {
    for (const auto& p : segments_[s]->points()) {
      std::optional<NodeId> nearest;
      float distance = std::numeric_limits<float>::infinity();
      for (const auto& [id, surface] : nodes_) {
        const auto found = surface->nearest(p, radius_.at(id));
        if (!found || found->squared_distance >= distance) continue;
        nearest = id;
        distance = found->squared_distance;
      }
      if (nearest) ++places_at_node_[s][*nearest];
    }
  }
  for (const auto& [id, surface] : nodes_) {
    for (const auto& p : surface->points()) {
      std::optional<std::size_t> nearest;
      float distance = std::numeric_limits<float>::infinity();
      for (std::size_t s = 0; s < segments_.size(); ++s) {
        if (!places_at_node_[s].contains(id)) continue;
        const auto found = segments_[s]->nearest(p, radius_.at(id));
        if (!found || found->squared_distance >= distance) continue;
        nearest = s;
        distance = found->squared_distance;
      }
      if (!nearest) continue;
      ++places_of_node_[*nearest][id];
      ++shown_[id];
    }
  }
}

double SharedSurfaces::share(std::size_t segment, NodeId node) const {
  const auto found = places_at_node_[segment].find(node);
  if (found == places_at_node_[segment].end()) return 0.0;
  return static_cast<double>(found->second) / static_cast<double>(segments_[segment]->points().size());
}

std::optional<NodeId> SharedSurfaces::mainNode(std::size_t segment) const {
  const auto& at = places_at_node_[segment];
  const auto best = std::max_element(at.begin(), at.end(),
                                     [](const auto& a, const auto& b) { return a.second < b.second; });
  if (best == at.end()) return std::nullopt;
  const NodeId id = best->first;
  const auto& of_node = places_of_node_[segment];
  const auto shows = of_node.find(id);
  const std::size_t shown = shows == of_node.end() ? 0 : shows->second;
  const bool is_main =
      4 * best->second >= segments_[segment]->points().size() || 2 * shown >= nodes_.at(id)->points().size();
  return is_main ? std::optional(id) : std::nullopt;
}

std::vector<NodeId> SharedSurfaces::othersIn(std::size_t segment) const {
  constexpr std::size_t kLeastPlaces = 10;  // 1.6 cm^2
  const auto main = mainNode(segment);
  std::vector<NodeId> others;
  for (const auto& [id, places] : places_of_node_[segment]) {
    const auto at = places_at_node_[segment].find(id);
    if (id == main || at == places_at_node_[segment].end() || at->second < kLeastPlaces) continue;
    if (2 * places > shown_.at(id)) others.push_back(id);
  }
  return others;
}

std::vector<std::size_t> SharedSurfaces::nearestOf(const PointCloud& world_points,
                                                   std::span<const NodeId> nodes) const {
  constexpr float kFar = 10.0F;  // m
  std::vector<std::size_t> nearest(world_points.size(), 0);
  for (std::size_t i = 0; i < world_points.size(); ++i) {
    float distance = kFar * kFar;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto found = nodes_.at(nodes[n])->nearest(world_points[i], std::sqrt(distance));
      if (!found || found->squared_distance >= distance) continue;
      nearest[i] = n;
      distance = found->squared_distance;
    }
  }
  return nearest;
}

std::vector<SharedSurfaces::Place> SharedSurfaces::placesOf(NodeId node,
                                                            std::span<const std::size_t> segments) const {
  constexpr float kReach = 0.03F;  // m
  std::vector<Place> places;
  for (const auto& p : nodes_.at(node)->points()) {
    Place place{p, std::nullopt};
    float distance = kReach;
    for (const std::size_t s : segments) {
      const auto found = segments_[s]->nearest(p, distance);
      if (!found || found->squared_distance >= distance * distance) continue;
      place.segment = s;
      distance = std::sqrt(found->squared_distance);
    }
    places.push_back(place);
  }
  return places;
}

}  // namespace hoctomap
