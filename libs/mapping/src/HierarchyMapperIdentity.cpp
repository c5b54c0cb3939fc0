// SPDX-License-Identifier: BSD-3-Clause
// One object is one node (docs/decisions/0023): segments that bridge nodes are divided or make them one,
// nodes that scans show to be two objects are split.
#include <algorithm>
#include <utility>

#include "NodeEvidence.h"
#include "SharedSurfaces.h"

namespace hoctomap {

namespace {

/// How many scans that join it takes to outvote one that cuts. S overlooks a seam more often than it makes
/// one up: of things of like size every third view is right to cut. Small pieces (handles, lids, what shows
/// behind a rim) are cut off for other reasons, too. @param relative_size  of the smaller of the two to the
/// larger
double weightOfCut(double relative_size) {
  constexpr double kMost = 3.0;
  return std::min(kMost, 1.0 + 4.0 * relative_size);
}

double relativeSize(std::size_t a, std::size_t b) {
  return static_cast<double>(std::min(a, b)) / static_cast<double>(std::max<std::size_t>(1, std::max(a, b)));
}

/// Whether the scans so far speak for two objects where two sets of cells meet.
bool areTwo(const SeamVotes& seams, const SeamVotes::Cells& a, const SeamVotes::Cells& b) {
  const SeamVotes::Verdict v = seams.between(a, b);
  return weightOfCut(relativeSize(a.size(), b.size())) * v.apart > v.joined;
}

/// Whether they speak for one; one scan alone never does.
bool areOne(const SeamVotes& seams, const SeamVotes::Cells& a, const SeamVotes::Cells& b) {
  constexpr double kLeastScans = 2.0;
  const SeamVotes::Verdict v = seams.between(a, b);
  return v.pairs > 0.0 && v.joined > weightOfCut(relativeSize(a.size(), b.size())) * v.apart &&
         v.joined >= kLeastScans * v.pairs;
}

/// Share of the points that lie in the box.
double shareInside(const PointCloud& world_points, const Obb& box) {
  const Eigen::Isometry3d frame_T_world = box.world_T_frame.inverse();
  const auto inside = std::count_if(world_points.begin(), world_points.end(), [&](const Eigen::Vector3f& p) {
    return box.box.contains(frame_T_world * p.cast<double>());
  });
  return static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(1, world_points.size()));
}

SeamVotes::Cells cellsOf(const MapHierarchy& hierarchy, NodeId id) {
  return SeamVotes::cellsOf(worldSurface(hierarchy, id));
}

}  // namespace

void HierarchyMapper::settleIdentity(const Measurement& z, std::vector<LabelledPart>& parts,
                                     const NodeEvidence& evidence, UpdateReport& report) {
  std::vector<std::size_t> clusters;
  std::vector<const PointCloud*> points;
  std::set<NodeId> near;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].structure != Structure::cluster) continue;
    clusters.push_back(i);
    points.push_back(&parts[i].world_points);
    for (const NodeId id : hierarchy_.idsNear(worldBounds(parts[i].box))) {
      if (isOfKind(id, parts[i].label) && !evidence.contradicts(id)) near.insert(id);
    }
  }
  seams_.add(points);
  if (near.empty()) return;
  const SharedSurfaces surfaces(hierarchy_, points, std::vector<NodeId>(near.begin(), near.end()));
  std::map<NodeId, std::vector<std::size_t>> claims;  // the segments of every node
  for (std::size_t s = 0; s < clusters.size(); ++s) {
    LabelledPart& part = parts[clusters[s]];
    if (part.moved_node) {
      claims[*part.moved_node].push_back(s);
    } else if (const auto main = surfaces.mainNode(s); main && isOfKind(*main, part.label)) {
      part.label = hierarchy_.node(*main).label();
      claims[*main].push_back(s);
      part.moved_node = main;
    } else {
      const auto by_box =
          strategies_.association->associate(hierarchy_, {part.label, &part.world_points, part.box},
                                             [&](NodeId id) { return near.contains(id); });
      constexpr double kMostly = 0.5;
      if (by_box && shareInside(part.world_points, hierarchy_.box(*by_box)) > kMostly)
        part.moved_node = by_box;
      part.is_new = !part.moved_node;
    }
  }
  for (auto& [id, segments] : claims) {
    if (segments.size() > 1 && near.contains(id))
      splitNode(z, id, segments, surfaces, parts, clusters, report);
  }
  divideSegments(z, surfaces, parts, clusters, report);
}

bool HierarchyMapper::isOfKind(NodeId id, const Label& label) const {
  return strategies_.labeling->areOfOneKind(std::as_const(hierarchy_).node(id).label(), label);
}

void HierarchyMapper::splitNode(const Measurement& z, NodeId id, std::vector<std::size_t>& segments,
                                const SharedSurfaces& surfaces, std::vector<LabelledPart>& parts,
                                const std::vector<std::size_t>& clusters, UpdateReport& report) {
  // The segment that shows most of it goes on as this node.
  std::stable_sort(segments.begin(), segments.end(), [&](std::size_t a, std::size_t b) {
    return parts[clusters[a]].points.size() > parts[clusters[b]].points.size();
  });
  const auto places = surfaces.placesOf(id, segments);
  for (std::size_t k = 1; k < segments.size(); ++k) {
    PointCloud own;
    PointCloud other;
    for (const auto& place : places) {
      if (!place.segment) continue;
      if (*place.segment == segments[k]) other.push_back(place.world_point);
      if (*place.segment == segments[0]) own.push_back(place.world_point);
    }
    if (!areTwo(seams_, SeamVotes::cellsOf(own), SeamVotes::cellsOf(other))) continue;
    splitOff(z, id, own, other, parts[clusters[segments[k]]], report);
  }
}

void HierarchyMapper::splitOff(const Measurement& z, NodeId id, const PointCloud& own,
                               const PointCloud& other, LabelledPart& part, UpdateReport& report) {
  constexpr float kSpacing = 0.004F;
  constexpr float kReach = 0.05F;
  const SurfacePoints stays(own, kSpacing);
  const SurfacePoints goes(other, kSpacing);
  const Eigen::Isometry3f world_T_node = toIsometry(hierarchy_.world_T_node(id)).cast<float>();
  const auto isOther = [&](const Eigen::Vector3f& p) {
    const auto there = goes.nearest(world_T_node * p, kReach);
    const auto here = stays.nearest(world_T_node * p, kReach);
    return there && (!here || there->squared_distance < here->squared_distance);
  };
  // In the frame of the node it was a part of, voxels stay voxels.
  UpdateReport quiet;  // it is no creation
  const NodeId split = createNode(z, part, quiet, hierarchy_.world_T_node(id));
  MapNode& node = hierarchy_.node(id);
  MapNode& piece = hierarchy_.node(split);
  node.map().give(piece.map(), Eigen::Isometry3d::Identity(), isOther);
  node.version = piece.version = z.scan;
  piece.first_scan = node.first_scan;
  piece.existence_log_odds = node.existence_log_odds;
  piece.confirmation = node.confirmation;
  if (piece.confirmation.waits) {
    waiting_.insert(split);
  } else {
    waiting_.erase(split);
  }
  part.moved_node = split;
  note(report, NodeEventKind::split, split, "from node " + std::to_string(id.value));
}

void HierarchyMapper::divideSegments(const Measurement& z, const SharedSurfaces& surfaces,
                                     std::vector<LabelledPart>& parts,
                                     const std::vector<std::size_t>& clusters, UpdateReport& report) {
  for (std::size_t s = 0; s < clusters.size(); ++s) {
    const auto main = parts[clusters[s]].moved_node;
    if (!main || surfaces.mainNode(s) != main) continue;
    std::vector<NodeId> holders{*main};
    for (const NodeId other : surfaces.othersIn(s)) {
      if (!hierarchy_.contains(other) || !hierarchy_.contains(holders.front())) continue;
      if (!isOfKind(other, parts[clusters[s]].label)) continue;
      if (!areOne(seams_, cellsOf(hierarchy_, holders.front()), cellsOf(hierarchy_, other))) {
        holders.push_back(other);
        continue;
      }
      const auto size = [&](NodeId n) { return hierarchy_.node(n).map().occupiedVoxels().size(); };
      const bool swap = size(other) > size(holders.front());
      const NodeId piece = swap ? holders.front() : other;
      if (swap) holders.front() = other;
      mergeInto(holders.front(), piece, z.scan, report);
      for (LabelledPart& part : parts) {
        if (part.moved_node == piece) part.moved_node = holders.front();
        if (part.joined_with == piece) part.joined_with = holders.front();
      }
    }
    parts[clusters[s]].moved_node = holders.front();
    if (holders.size() > 1) dividePart(clusters[s], holders, surfaces, parts);
  }
}

void HierarchyMapper::dividePart(std::size_t index, const std::vector<NodeId>& holders,
                                 const SharedSurfaces& surfaces, std::vector<LabelledPart>& parts) const {
  const LabelledPart whole = parts[index];
  const auto nearest = surfaces.nearestOf(whole.world_points, holders);
  for (std::size_t h = 0; h < holders.size(); ++h) {
    LabelledPart part{whole.structure, {}, {}, whole.label, {}, holders[h], {}};
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      if (nearest[i] != h) continue;
      part.points.push_back(whole.points[i]);
      part.world_points.push_back(whole.world_points[i]);
    }
    part.box = pcaBox(part.world_points);
    part.label = hierarchy_.node(holders[h]).label();
    part.joined_with = h == 0 ? std::nullopt : std::optional(holders.front());
    if (h == 0) {
      parts[index] = std::move(part);
    } else if (!part.points.empty()) {
      parts.push_back(std::move(part));
    }
  }
}

}  // namespace hoctomap
