// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/query/HierarchyMerge.h"

#include <algorithm>
#include <map>
#include <stdexcept>
#include <utility>

#include "VoxelTree.h"
#include "hoctomap/existence/ExistenceFilter.h"

namespace hoctomap {

namespace {

/// A node as a surface in the result's world.
struct Surface {
  Surface(const MapNode& node, const Eigen::Isometry3d& world_T_node)
      : voxels(inWorld(node.map().occupiedVoxels(), world_T_node)), tree(voxels) {}

  PointCloud voxels;
  VoxelTree tree;

 private:
  static PointCloud inWorld(const PointCloud& node_points, const Eigen::Isometry3d& world_T_node) {
    PointCloud points;
    for (const auto& p : node_points) points.push_back((world_T_node * p.cast<double>()).cast<float>());
    return points;
  }
};

/// Share of the voxels of `a` that lie on `b`.
double shareOn(const Surface& a, const Surface& b, double near) {
  const auto count =
      std::count_if(a.voxels.begin(), a.voxels.end(), [&](const auto& p) { return b.tree.hasNear(p, near); });
  return static_cast<double>(count) / static_cast<double>(a.voxels.size());
}

bool isAlike(const MapNode& a, const MapNode& b) {
  return a.label() == b.label() && a.map().resolution() == b.map().resolution();
}

/// The result while part after part is taken in.
class Merger {
 public:
  Merger(const MergePart& first, const LabelProfiles& profiles, const MergeConfig& config)
      : profiles_(profiles),
        config_(config),
        merged_{
            MapHierarchy(first.hierarchy.root().label(), NodeMap(first.hierarchy.root().map().resolution(),
                                                                 first.hierarchy.root().map().model())),
            {},
            {},
            0} {}

  void take(const MergePart& part);
  [[nodiscard]] MergedMaps result() && { return std::move(merged_); }

 private:
  using Same = std::map<NodeId, std::vector<NodeId>>;  ///< of a node of the part: the result's

  [[nodiscard]] Same findSame(const MergePart& part) const;
  void fuse(const MergePart& part, NodeId from, NodeId into);
  NodeId adopt(const MergePart& part, NodeId from, NodeId parent);
  void join(NodeId whole, NodeId piece);
  void confirm(NodeId id, const MapNode& by, const std::string& detail);
  void addExistence(NodeId id, double log_odds);
  [[nodiscard]] NodeId now(NodeId id) const;
  void note(NodeEventKind kind, NodeId id, std::string detail);

  const LabelProfiles& profiles_;
  const MergeConfig& config_;
  MergedMaps merged_;
  UpdateReport report_;
  std::map<NodeId, NodeId> joined_;  ///< nodes that have become another one
};

Merger::Same Merger::findSame(const MergePart& part) const {
  const MapHierarchy& map = merged_.hierarchy;
  std::map<NodeId, std::size_t> order;  // of the result's nodes: parents first
  for (const NodeId id : map.preorder()) order.emplace(id, order.size());
  std::map<NodeId, Surface> known;  // those that were compared
  Same same;
  for (const NodeId from : part.hierarchy.preorder()) {
    const MapNode& node = part.hierarchy.node(from);
    if (from == kRootId || node.map().occupiedVoxels().empty()) continue;
    Obb box = part.hierarchy.box(from);
    box.world_T_frame = toIsometry(part.world_T_map) * box.world_T_frame;
    std::vector<NodeId> candidates = map.idsNear(worldBounds(box));
    std::erase_if(candidates, [&](NodeId id) {
      return id == kRootId || !isAlike(map.node(id), node) || !intersects(map.box(id), box);
    });
    if (candidates.empty()) continue;
    std::ranges::sort(candidates, {}, [&](NodeId id) { return order.at(id); });
    const Surface surface(node, toIsometry(part.world_T_map + part.hierarchy.world_T_node(from)));
    const double near = config_.near + node.map().resolution();
    for (const NodeId id : candidates) {
      const auto at = known.find(id);
      const Surface& other =
          at != known.end()
              ? at->second
              : known.try_emplace(id, map.node(id), toIsometry(map.world_T_node(id))).first->second;
      if (std::max(shareOn(surface, other, near), shareOn(other, surface, near)) >= config_.overlap)
        same[from].push_back(id);
    }
  }
  return same;
}

void Merger::take(const MergePart& part) {
  report_ = {};
  report_.scan = merged_.scans + std::max<std::uint64_t>(part.scans, 1) - 1;
  report_.stamp = part.last_stamp;
  const Same same = findSame(part);
  std::map<NodeId, NodeId> taken{{kRootId, kRootId}};
  fuse(part, kRootId, kRootId);
  for (const NodeId from : part.hierarchy.preorder()) {
    if (from == kRootId) continue;
    const NodeId parent = now(taken.at(*part.hierarchy.node(from).parent()));
    const auto found = same.find(from);
    if (found == same.end()) {
      taken[from] = adopt(part, from, parent);
      continue;
    }
    NodeId into = now(found->second.front());
    for (const NodeId other : found->second) {
      const NodeId piece = now(other);
      // One view alone does not show that two nodes are one.
      if (piece != into && !part.hierarchy.node(from).confirmation.waits)
        join(std::min(into, piece), std::max(into, piece));
      into = now(into);
    }
    fuse(part, from, into);
    // What stands on a table that only this part has seen.
    const bool knows_more = merged_.hierarchy.node(into).parent() == kRootId && parent != kRootId;
    if (knows_more && !merged_.hierarchy.isInSubtree(parent, into)) merged_.hierarchy.reparent(into, parent);
    taken[from] = into;
  }
  merged_.scans += part.scans;
  merged_.reports.push_back(std::move(report_));
}

void Merger::fuse(const MergePart& part, NodeId from, NodeId into) {
  const MapNode& source = part.hierarchy.node(from);
  MapNode& node = merged_.hierarchy.node(into);
  const Pose into_T_from =
      -merged_.hierarchy.world_T_node(into) + (part.world_T_map + part.hierarchy.world_T_node(from));
  const bool first = into == kRootId && merged_.reports.empty();
  node.map().add(source.map(), toIsometry(into == kRootId ? part.world_T_map : into_T_from));
  node.first_scan = first ? source.first_scan : std::min(node.first_scan, merged_.scans + source.first_scan);
  node.last_scan = std::max(node.last_scan, merged_.scans + source.last_scan);
  node.version = report_.scan;
  if (first) {
    node.existence_log_odds = source.existence_log_odds;
  } else {
    addExistence(into, source.existence_log_odds);
  }
  const std::string detail = "by node " + std::to_string(from.value) + " of map " + part.name;
  if (node.confirmation.waits) {
    confirm(into, source, detail);
  } else {
    note(NodeEventKind::updated, into, detail);
  }
}

NodeId Merger::adopt(const MergePart& part, NodeId from, NodeId parent) {
  const MapNode& source = part.hierarchy.node(from);
  NodeMap map(std::make_unique<octomap::OcTree>(source.map().tree()), source.map().model());
  const NodeId id = merged_.hierarchy.add(source.label(), std::move(map),
                                          part.world_T_map + part.hierarchy.world_T_node(from), parent);
  MapNode& node = merged_.hierarchy.node(id);
  node.existence_log_odds = source.existence_log_odds;
  node.first_scan = merged_.scans + source.first_scan;
  node.last_scan = merged_.scans + source.last_scan;
  node.version = report_.scan;
  if (source.confirmation.waits) node.confirmation = source.confirmation;
  note(NodeEventKind::created, id, "node " + std::to_string(from.value) + " of map " + part.name);
  return id;
}

/// Two nodes so far, of which this part says that they are one.
void Merger::join(NodeId whole, NodeId piece) {
  MapHierarchy& map = merged_.hierarchy;
  if (map.isInSubtree(whole, piece)) map.reparent(whole, *map.node(piece).parent());
  const std::vector<NodeId> children = map.node(piece).children();
  for (const NodeId child : children) {
    if (child != whole) map.reparent(child, whole);
  }
  const Pose world_T_piece = map.world_T_node(piece);
  map.node(whole).map().add(map.node(piece).map(), toIsometry(-map.world_T_node(whole) + world_T_piece));
  map.node(whole).version = report_.scan;
  map.node(whole).first_scan = std::min(map.node(whole).first_scan, map.node(piece).first_scan);
  map.node(whole).last_scan = std::max(map.node(whole).last_scan, map.node(piece).last_scan);
  addExistence(whole, map.node(piece).existence_log_odds);
  note(NodeEventKind::merged, piece, "into node " + std::to_string(whole.value));
  joined_[piece] = whole;
  MapNode gone = map.remove(piece);
  if (map.node(whole).confirmation.waits) confirm(whole, gone, "with node " + std::to_string(piece.value));
  if (!gone.confirmation.waits) merged_.removed.push_back({std::move(gone), world_T_piece, report_.scan});
}

/// A node that waits has been shown again, by another node that has become part of it: as in one log, views
/// confirm each other (docs/decisions/0022).
void Merger::confirm(NodeId id, const MapNode& by, const std::string& detail) {
  Confirmation& confirmation = merged_.hierarchy.node(id).confirmation;
  confirmation.shown += by.confirmation.shown;
  confirmation.missed += by.confirmation.missed;
  if (by.confirmation.waits && confirmation.shown < config_.confirm_scans) return;
  confirmation = {};
  note(NodeEventKind::created, id, detail);
}

void Merger::addExistence(NodeId id, double log_odds) {
  MapNode& node = merged_.hierarchy.node(id);
  const LabelProfile& profile = profiles_.at(node.label());
  if (!profile.existence_enabled) return;
  ExistenceEntry entry{id, {}, 0.0};
  entry.evidence.informative = true;
  entry.evidence.p_measurement = probability(log_odds);
  node.existence_log_odds =
      ExistenceFilter(profile.existence).update(node.existence_log_odds, entry.evidence.p_measurement);
  if (node.confirmation.waits) return;  // nobody has heard of it
  entry.p_posterior = node.existence();
  report_.existence.push_back(entry);
}

NodeId Merger::now(NodeId id) const {
  for (auto next = joined_.find(id); next != joined_.end(); next = joined_.find(id)) id = next->second;
  return id;
}

void Merger::note(NodeEventKind kind, NodeId id, std::string detail) {
  const MapNode& node = merged_.hierarchy.node(id);
  if (node.confirmation.waits) return;
  report_.events.push_back({kind, id, node.label(), node.existence(), std::move(detail)});
}

}  // namespace

MergedMaps mergeMaps(std::span<const MergePart> parts, const LabelProfiles& profiles,
                     const MergeConfig& config) {
  if (parts.empty()) throw std::invalid_argument("there is nothing to merge");
  Merger merger(parts.front(), profiles, config);
  for (const MergePart& part : parts) merger.take(part);
  return std::move(merger).result();
}

}  // namespace hoctomap
