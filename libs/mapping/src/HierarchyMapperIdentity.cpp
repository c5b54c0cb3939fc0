// SPDX-License-Identifier: BSD-3-Clause
// One object is one node (docs/decisions/0028): nodes follow the regions that the votes of all scans make of
// the surface, and so do the segments of a scan.
#include <algorithm>
#include <utility>

#include "BridgedNodes.h"
#include "FreeGap.h"
#include "NodeEvidence.h"
#include "NodeRegions.h"
#include "SurfacePoints.h"
#include "hoctomap/geometry/ForEachIndex.h"
#include "hoctomap/geometry/PcaFrame.h"

namespace hoctomap {

namespace {

using Region = SurfaceRegions::Region;

/// Share of the points that lie in the box.
double shareInside(const PointCloud& world_points, const Obb& box) {
  const Eigen::Isometry3d frame_T_world = box.world_T_frame.inverse();
  const auto inside = std::count_if(world_points.begin(), world_points.end(), [&](const Eigen::Vector3f& p) {
    return box.box.contains(frame_T_world * p.cast<double>());
  });
  return static_cast<double>(inside) / static_cast<double>(std::max<std::size_t>(1, world_points.size()));
}

/// Whether a scan sees through between two regions of a node.
bool isSeenBetween(const MapHierarchy& hierarchy, NodeId id, Region a, Region b,
                   const SurfaceRegions& regions, const ScanSight& sight) {
  PointCloud in_a;
  PointCloud in_b;
  for (const auto& p : worldSurface(hierarchy, id)) {
    const auto region = regions.at(SeamVotes::cellOf(p));
    if (region == a) in_a.push_back(p);
    if (region == b) in_b.push_back(p);
  }
  return hasFreeGap(sight, in_a, in_b);
}

/// The regions of a segment, point by point.
struct SegmentRegions {
  std::vector<std::optional<Region>> of_point;
  std::optional<Region> most;  ///< that has most of the points
};

/// Points without a region, and those in scraps or apart from the rest that are no node's, go with most of
/// the segment. So do those that reach into another region by the cells along the seam only: S knows it to
/// the pixel.
SegmentRegions regionsOf(const PointCloud& world_points, const SurfaceRegions& regions,
                         const NodeRegions& held) {
  SegmentRegions found;
  std::map<SeamVotes::Cell, std::size_t> cells;
  std::map<Region, std::size_t> points;
  found.of_point.reserve(world_points.size());
  std::optional<SeamVotes::Cell> last;
  std::size_t* of_cell = nullptr;
  for (const auto& p : world_points) {
    const SeamVotes::Cell cell = SeamVotes::cellOf(p);
    if (cell != last) {  // neighbours often share one
      last = cell;
      found.of_point.push_back(regions.at(cell));
      of_cell = found.of_point.back() ? &cells[cell] : nullptr;
    } else {
      found.of_point.push_back(found.of_point.back());
    }
    if (of_cell != nullptr) ++*of_cell;
  }
  for (const auto& [cell, n] : cells) points[*regions.at(cell)] += n;
  if (points.empty()) return found;
  const Region most = std::max_element(points.begin(), points.end(), [](const auto& a, const auto& b) {
                        return a.second < b.second;
                      })->first;
  found.most = most;
  std::map<Region, std::size_t> along_seam;
  for (const auto& [cell, n] : cells) {
    if (regions.isBeside(cell, most)) along_seam[*regions.at(cell)] += n;
  }
  std::map<Region, Region> goes_to;
  for (const auto& [region, n] : points) {
    const bool has_seam = regions.size(region) >= kFragmentCells && regions.meet(region, most);
    const bool is_spill = 4 * along_seam[region] > 3 * n;
    goes_to[region] = !is_spill && (has_seam || held.isHeld(region)) ? region : most;
  }
  for (auto& region : found.of_point) region = region ? goes_to.at(*region) : most;
  return found;
}

}  // namespace

void HierarchyMapper::settleIdentity(const Measurement& z, PreparedScan& prepared,
                                     const NodeEvidence& evidence, UpdateReport& report) {
  std::vector<LabelledPart>& parts = prepared.parts;
  std::set<NodeId> near;
  for (const LabelledPart& part : parts) {
    if (part.structure != Structure::cluster) continue;
    for (const NodeId id : hierarchy_.idsNear(worldBounds(part.box))) {
      if (isOfKind(id, part.label) && !evidence.contradicts(id)) near.insert(id);
    }
  }
  const SeamVotes::Cells shown = seams_.add(prepared.seams);
  if (shown.empty()) return;
  const SurfaceRegions regions(seams_, shown);
  NodeRegions held(hierarchy_, std::vector<NodeId>(near.begin(), near.end()), regions);
  mergeOwners(z, regions, held, parts, report);
  splitHolders(z, regions, held, report);
  divideSegments(regions, held, near, parts);
}

/// A table that was seen in parts is one as soon as a scan shows them as one plane. Seams between planes have
/// no votes: what S takes for one plane, however seldom, has no step.
void HierarchyMapper::mergeBridged(const Measurement& z, const std::vector<LabelledPart>& parts,
                                   UpdateReport& report) {
  for (const LabelledPart& part : parts) {
    if (part.structure != Structure::plane) continue;
    std::vector<NodeId> near;
    for (const NodeId id : hierarchy_.idsNear(worldBounds(part.box))) {
      // What stands on a table is none of its parts, though somebody calls it a table.
      const auto parent = hierarchy_.node(id).parent();
      if (hierarchy_.node(id).label() == part.label &&
          (!parent || hierarchy_.node(*parent).label() != part.label))
        near.push_back(id);
    }
    if (near.size() < 2) continue;
    std::vector<NodeId> bridged = bridgedNodes(hierarchy_, near, part.world_points);
    keepLargestFirst(bridged);
    for (std::size_t k = 1; k < bridged.size(); ++k) {
      mergeInto(bridged[0], bridged[k], z.scan, report);
    }
  }
}

void HierarchyMapper::keepLargestFirst(std::vector<NodeId>& owners) const {
  const auto size = [&](NodeId n) { return hierarchy_.node(n).map().occupiedVoxels().size(); };
  std::stable_sort(owners.begin(), owners.end(), [&](NodeId a, NodeId b) { return size(a) > size(b); });
}

bool HierarchyMapper::isOfKind(NodeId id, const Label& label) const {
  return strategies_.labeling->areOfOneKind(std::as_const(hierarchy_).node(id).label(), label);
}

void HierarchyMapper::mergeOwners(const Measurement& z, const SurfaceRegions& regions, NodeRegions& held,
                                  std::vector<LabelledPart>& parts, UpdateReport& report) {
  for (Region region = 0; region < regions.count(); ++region) {
    std::vector<NodeId> owners = held.ownersOf(region);
    keepLargestFirst(owners);
    for (std::size_t k = 1; k < owners.size(); ++k) {
      if (!isOfKind(owners[k], hierarchy_.node(owners[0]).label())) continue;
      mergeInto(owners[0], owners[k], z.scan, report);
      held.merge(owners[0], owners[k]);
      for (LabelledPart& part : parts) {
        if (part.moved_node == owners[k]) part.moved_node = owners[0];
      }
    }
  }
}

void HierarchyMapper::splitHolders(const Measurement& z, const SurfaceRegions& regions, NodeRegions& held,
                                   UpdateReport& report) {
  std::optional<ScanSight> sight;  // most scans have no need of it
  const auto areApart = [&](NodeId id, Region a, Region b) {
    if (!sight) sight.emplace(z, config_.reidentification.registration.near, config_.reidentification.noise);
    return isSeenBetween(hierarchy_, id, a, b, regions, *sight);
  };
  for (Region region = 0; region < regions.count(); ++region) {
    for (const NodeId id : held.nodes()) {
      if (!held.othersOf(id).contains(region)) continue;
      const auto owners = held.ownersOf(region);
      if (!owners.empty()) {  // a scrap of a neighbour
        handOver(z, id, owners.front(), region, regions);
        held.give(id, owners.front(), region);
      } else if (const Region main = *held.mainOf(id);
                 regions.meet(region, main) || areApart(id, main, region)) {
        held.give(id, splitOff(z, id, region, regions, report), region);
      }
    }
  }
}

void HierarchyMapper::handOver(const Measurement& z, NodeId from, NodeId to, std::uint32_t region,
                               const SurfaceRegions& regions) {
  const Eigen::Isometry3d world_T_from = toIsometry(hierarchy_.world_T_node(from));
  const Eigen::Isometry3d world_T_to = toIsometry(hierarchy_.world_T_node(to));
  const Eigen::Isometry3f world_T_voxels = world_T_from.cast<float>();
  MapNode& giver = hierarchy_.node(from);
  MapNode& taker = hierarchy_.node(to);
  giver.map().give(taker.map(), world_T_to.inverse() * world_T_from, [&](const Eigen::Vector3f& p) {
    return regions.at(SeamVotes::cellOf(world_T_voxels * p)) == region;
  });
  giver.version = taker.version = z.scan;
}

NodeId HierarchyMapper::splitOff(const Measurement& z, NodeId id, std::uint32_t region,
                                 const SurfaceRegions& regions, UpdateReport& report) {
  LabelledPart part{Structure::cluster, {}, {}, hierarchy_.node(id).label(), {}, {}, {}};
  for (const auto& p : worldSurface(hierarchy_, id)) {
    if (regions.at(SeamVotes::cellOf(p)) == region) part.world_points.push_back(p);
  }
  part.box = pcaBox(part.world_points);
  // In the frame of the node it was a part of, voxels stay voxels.
  UpdateReport quiet;  // it is no creation
  const NodeId split = createNode(z, part, quiet, hierarchy_.world_T_node(id));
  handOver(z, id, split, region, regions);
  MapNode& node = hierarchy_.node(id);
  MapNode& piece = hierarchy_.node(split);
  piece.first_scan = node.first_scan;
  piece.last_scan = node.last_scan;
  piece.existence_log_odds = node.existence_log_odds;
  piece.confirmation = node.confirmation;
  if (piece.confirmation.waits) {
    waiting_.insert(split);
  } else {
    waiting_.erase(split);
  }
  note(report, NodeEventKind::split, split, "from node " + std::to_string(id.value));
  return split;
}

void HierarchyMapper::divideSegments(const SurfaceRegions& regions, const NodeRegions& held,
                                     const std::set<NodeId>& near, std::vector<LabelledPart>& parts) const {
  // The points of every region, of all segments; the label is that of the segment that has most of them.
  struct Share {
    std::vector<std::pair<std::uint32_t, Eigen::Vector3f>> points;  // by their number in the scan
    std::map<std::size_t, std::size_t> segments;
  };
  std::map<Region, Share> shares;
  std::map<std::size_t, Region> most_of_segment;
  std::set<std::size_t> divided;
  std::vector<LabelledPart> settled;
  std::vector<SegmentRegions> regions_of(parts.size());
  forEachIndex(parts.size(), [&](std::size_t s) {
    if (parts[s].structure == Structure::cluster && !parts[s].moved_node)
      regions_of[s] = regionsOf(parts[s].world_points, regions, held);
  });
  for (std::size_t s = 0; s < parts.size(); ++s) {
    LabelledPart& part = parts[s];
    const SegmentRegions& found = regions_of[s];
    if (!found.most) {
      settled.push_back(std::move(part));
      continue;
    }
    most_of_segment[s] = *found.most;
    if (std::any_of(found.of_point.begin(), found.of_point.end(),
                    [&](const auto& region) { return region != found.most; }))
      divided.insert(s);
    std::optional<Region> last;
    Share* share = nullptr;
    for (std::size_t i = 0; i < found.of_point.size(); ++i) {
      if (found.of_point[i] != last) {  // neighbours are often of one
        last = found.of_point[i];
        share = &shares[*last];
      }
      share->points.emplace_back(part.points[i], part.world_points[i]);
      ++share->segments[s];
    }
  }
  for (auto& [region, share] : shares) {
    const auto comes_before = [](const auto& a, const auto& b) { return a.first < b.first; };
    if (!std::is_sorted(share.points.begin(), share.points.end(), comes_before))  // those of one segment are
      std::sort(share.points.begin(), share.points.end(), comes_before);
    const std::size_t segment =
        std::max_element(share.segments.begin(), share.segments.end(), [](const auto& a, const auto& b) {
          return a.second < b.second;
        })->first;
    LabelledPart part{Structure::cluster, {}, {}, parts[segment].label, {}, {}, {}};
    for (const auto& [index, point] : share.points) {
      part.points.push_back(index);
      part.world_points.push_back(point);
    }
    part.box = pcaBox(part.world_points);
    part.moved_node = nodeOf(region, part, regions, held, near);
    part.is_new = !part.moved_node;
    if (part.moved_node) part.label = hierarchy_.node(*part.moved_node).label();
    part.is_divided = std::any_of(share.segments.begin(), share.segments.end(),
                                  [&](const auto& entry) { return divided.contains(entry.first); });
    // What this scan has not shown by itself is not confirmed by it.
    const Region most = most_of_segment.at(segment);
    const auto owners = held.ownersOf(most);
    if (most != region && !owners.empty()) part.joined_with = owners.front();
    settled.push_back(std::move(part));
  }
  parts = std::move(settled);
}

PointCloud HierarchyMapper::cededPoints(NodeId id, const std::vector<LabelledPart*>& parts,
                                        const std::vector<NodeId>& nodes) const {
  PointCloud ceded;
  const NodeMap& map = std::as_const(hierarchy_).node(id).map();
  if (map.occupiedBox().isEmpty()) return ceded;
  const Obb box = hierarchy_.box(id);
  const Eigen::Isometry3f node_T_world = toIsometry(hierarchy_.world_T_node(id)).inverse().cast<float>();
  const Eigen::AlignedBox3f inside = map.occupiedBox().cast<float>();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const LabelledPart& part = *parts[i];
    if (nodes[i] == id || part.structure != Structure::cluster || part.is_divided) continue;
    if (!isOfKind(id, part.label) || !intersects(box, part.box)) continue;
    for (const auto& p : part.world_points) {
      const Eigen::Vector3f q = node_T_world * p;
      if (inside.contains(q)) ceded.push_back(q);
    }
  }
  return ceded;
}

std::optional<NodeId> HierarchyMapper::nodeOf(std::uint32_t region, const LabelledPart& part,
                                              const SurfaceRegions& regions, const NodeRegions& held,
                                              const std::set<NodeId>& near) const {
  constexpr double kMostly = 0.5;
  const auto owners = held.ownersOf(region);
  if (!owners.empty()) return owners.front();
  for (const NodeId id : held.nodes()) {
    if (held.othersOf(id).contains(region)) return id;
  }
  // It shows nothing known. Another side of something known lies in its box, and there is no seam between.
  const auto by_box = strategies_.association->associate(
      hierarchy_, {part.label, &part.world_points, part.box}, [&](NodeId id) {
        const auto main = held.mainOf(id);
        return near.contains(id) && hierarchy_.contains(id) && !(main && regions.meet(*main, region));
      });
  if (!by_box || shareInside(part.world_points, hierarchy_.box(*by_box)) <= kMostly) return std::nullopt;
  return by_box;
}

}  // namespace hoctomap
