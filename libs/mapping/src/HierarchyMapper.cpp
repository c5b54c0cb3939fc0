// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/HierarchyMapper.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ContestedNodes.h"
#include "NodeEvidence.h"
#include "NodeUpdate.h"
#include "StageTimer.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/geometry/ForEachIndex.h"
#include "hoctomap/geometry/PcaFrame.h"

namespace hoctomap {

namespace {

MapHierarchy makeRoot(const LabelProfiles& profiles) {
  const auto found = profiles.find(labels::background);
  if (found == profiles.end()) throw ConfigError("label 'background' has no section [label.background]");
  MapHierarchy hierarchy(labels::background, NodeMap(found->second.resolution, found->second.occupancy));
  hierarchy.root().existence_log_odds = logOdds(found->second.existence.clamp_max);
  return hierarchy;
}

double smallerRange(double a, double b) {
  if (a < 0.0) return b;
  return b < 0.0 ? a : std::min(a, b);
}

/// What the scan says of where its clusters end.
ScanSeams seamsBetween(const std::vector<LabelledPart>& parts, const Eigen::Vector3d& origin) {
  std::vector<const PointCloud*> clusters;
  std::vector<const PointCloud*> ground;
  for (const LabelledPart& part : parts) {
    if (part.structure == Structure::cluster) clusters.push_back(&part.world_points);
    if (part.structure == Structure::plane) ground.push_back(&part.world_points);
  }
  return clusters.empty() ? ScanSeams{} : scanSeams(clusters, ground, origin);
}

}  // namespace

HierarchyMapper::HierarchyMapper(MappingConfig config, LabelProfiles profiles, MappingStrategies strategies)
    : HierarchyMapper(config, profiles, std::move(strategies), makeRoot(profiles)) {}

HierarchyMapper::HierarchyMapper(MappingConfig config, LabelProfiles profiles, MappingStrategies strategies,
                                 MapHierarchy hierarchy, SeamVotes seams, std::optional<StillSensor> sensor)
    : config_(config),
      profiles_(std::move(profiles)),
      strategies_(std::move(strategies)),
      hierarchy_(std::move(hierarchy)),
      seams_(std::move(seams)),
      sensor_(std::move(sensor)) {
  for (const NodeId id : hierarchy_.ids()) {
    if (std::as_const(hierarchy_).node(id).confirmation.waits) waiting_.insert(id);
  }
}

UpdateReport HierarchyMapper::integrate(const Measurement& z, PreparedScan prepared) {
  UpdateReport report;
  report.scan = z.scan;
  report.stamp = z.stamp;
  report.points = z.world_points.size();

  // III-C, step 1: segments with their labels.
  std::vector<LabelledPart>& parts = prepared.parts;
  report.seconds.segment = prepared.seconds;
  report.seconds.associate = prepared.seam_seconds;  // votes on seams are about which node is which

  if (!sensor_ || !sensor_->isAt(z.world_T_sensor)) sensor_ = StillSensor{z.world_T_sensor, z.scan};
  // What the whole measurement says of the nodes, before anything of it is integrated (III-D).
  NodeEvidence evidence;
  {
    const StageTimer timer(report.seconds.existence);
    evidence = gatherEvidence(z);
  }

  // What has moved is put where the scan shows it, so that its segments fall into its box (III-D). Nodes that
  // prove to be two objects, or one, are split or merged before segments are associated to them.
  {
    const StageTimer timer(report.seconds.associate);
    followMovedObjects(z, parts, evidence, report);
    if (config_.seam_votes) {
      mergeBridged(z, parts, report);
      settleIdentity(z, prepared, evidence, report);
    }
  }

  // The background first, then planes, then clusters: so that parents exist when their children come.
  std::vector<LabelledPart*> group;
  std::vector<NodeId> nodes;
  for (const Structure structure : {Structure::remainder, Structure::plane, Structure::cluster}) {
    // Step 2: associate each segment to a node, or create one.
    {
      const StageTimer timer(report.seconds.associate);
      std::vector<LabelledPart*> found;
      for (auto& part : parts) {
        if (part.structure == structure) found.push_back(&part);
      }
      const std::vector<NodeId> their_nodes = associate(z, found, evidence, report);
      group.insert(group.end(), found.begin(), found.end());
      nodes.insert(nodes.end(), their_nodes.begin(), their_nodes.end());
    }
    // Nothing that is associated depends on the root's map: it is updated beside the planes'.
    const bool only_root = std::all_of(nodes.begin(), nodes.end(), [](NodeId id) { return id == kRootId; });
    if (structure == Structure::remainder && only_root) continue;
    // Step 3: update the nodes' maps.
    const StageTimer timer(report.seconds.update);
    updateMaps(z, group, nodes, report);
    group.clear();
    nodes.clear();
  }

  // A node that is seen to be gone may have been found elsewhere before; pieces of others join them.
  {
    const StageTimer timer(report.seconds.associate);
    matchLate(z, evidence, report);
  }
  mergePieces(z, parts, evidence, report);

  // Eq. 8: nodes whose probability of existence falls below 0.5 are removed.
  const StageTimer timer(report.seconds.existence);
  applyExistence(z, evidence, report);
  // Those that a second view has shown are reported from now on.
  confirmNodes(parts, evidence, report);
  return report;
}

PreparedScan HierarchyMapper::prepare(const Measurement& z) const {
  PreparedScan prepared;
  {
    const StageTimer timer(prepared.seconds);
    prepared.parts = segmentAndLabel(z);
  }
  if (config_.seam_votes) {
    const StageTimer timer(prepared.seam_seconds);
    prepared.seams = seamsBetween(prepared.parts, z.origin());
  }
  return prepared;
}

std::vector<LabelledPart> HierarchyMapper::segmentAndLabel(const Measurement& z) const {
  std::vector<Segment> segments = strategies_.segmentation->segment(z);
  std::vector<LabelledPart> parts;
  parts.reserve(segments.size());
  for (Segment& segment : segments) {
    if (segment.points.empty()) continue;
    LabelledPart part{segment.structure, {}, {}, strategies_.labeling->label(z, segment), {}, {}, {}};
    static_cast<void>(profile(part.label));  // a label without a profile is an error at once
    part.points = std::move(segment.points);
    part.world_points.reserve(part.points.size());
    for (const auto i : part.points) part.world_points.push_back(z.world_points[i]);
    part.box = pcaBox(part.world_points);
    parts.push_back(std::move(part));
  }
  return parts;
}

HierarchyMapper::NodeEvidence HierarchyMapper::gatherEvidence(const Measurement& z) const {
  NodeEvidence gathered;
  if (!strategies_.existence) return gathered;
  std::vector<NodeInQuestion> nodes;
  for (const NodeId id : hierarchy_.idsNear(strategies_.existence->reach(z))) {
    const MapNode& node = hierarchy_.node(id);
    const LabelProfile& p = profile(node.label());
    if (id == kRootId || !p.existence_enabled) continue;
    nodes.push_back({id, p.existence, sensor_ && node.first_scan >= sensor_->since_scan});
  }
  const auto evidence = strategies_.existence->evidence(hierarchy_, z, nodes);
  for (std::size_t i = 0; i < nodes.size(); ++i) gathered.by_node[nodes[i].id] = evidence[i];
  return gathered;
}

namespace {

/// Whether a tenth of the points or more lie in the box of a node's occupied voxels.
bool goesThrough(const MapHierarchy& hierarchy, NodeId id, const PointCloud& world_points) {
  constexpr std::size_t kSamples = 400;
  constexpr std::size_t kTenth = 10;
  const Obb box = hierarchy.box(id);
  if (box.box.isEmpty()) return false;
  const Eigen::Isometry3d node_T_world = box.world_T_frame.inverse();
  const std::size_t step = std::max<std::size_t>(1, world_points.size() / kSamples);
  std::size_t asked = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < world_points.size(); i += step) {
    ++asked;
    if (box.box.contains(node_T_world * world_points[i].cast<double>())) ++inside;
  }
  return inside > 0 && kTenth * inside >= asked;
}

}  // namespace

std::vector<std::optional<NodeId>> HierarchyMapper::associateByBox(const std::vector<LabelledPart*>& parts,
                                                                   const NodeEvidence& evidence) const {
  std::vector<SegmentInQuestion> segments;
  for (const LabelledPart* part : parts) {
    // A node that this scan contradicts must not swallow what has moved into its box. But a plane where its
    // own is seen says that it is there, whatever the error of the pose makes of its beams.
    const Admissible admissible = [&](NodeId id) {
      return !evidence.contradicts(id) ||
             (part->structure == Structure::plane && goesThrough(hierarchy_, id, part->world_points));
    };
    const LabelledSegment segment{part->label, &part->world_points, part->box};
    segments.push_back({part->label, &part->world_points,
                        part->moved_node
                            ? part->moved_node
                            : strategies_.association->associate(hierarchy_, segment, admissible)});
  }
  if (config_.contest_at_surface) releaseStrangers(hierarchy_, segments);
  std::vector<std::optional<NodeId>> nodes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    nodes.push_back(parts[i]->moved_node ? parts[i]->moved_node
                    : parts[i]->is_new   ? std::nullopt
                                         : segments[i].node);
  }
  return nodes;
}

std::vector<NodeId> HierarchyMapper::associate(const Measurement& z, const std::vector<LabelledPart*>& parts,
                                               const NodeEvidence& evidence, UpdateReport& report) {
  std::vector<NodeId> nodes;
  const auto found = associateByBox(parts, evidence);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    // There is one background, whether or not any of it has been seen.
    const bool is_root = !found[i] && parts[i]->label == hierarchy_.root().label();
    nodes.push_back(found[i] ? *found[i] : is_root ? kRootId : createNode(z, *parts[i], report));
    parts[i]->node = nodes.back();
  }
  return nodes;
}

NodeId HierarchyMapper::createNode(const Measurement& z, const LabelledPart& part, UpdateReport& report,
                                   const std::optional<Pose>& frame) {
  const LabelProfile& p = profile(part.label);
  const NodeId parent = strategies_.relations.deepestAncestor(hierarchy_, {part.label, part.box, nullptr});
  // IV-A: the frame comes from the first measurement that is integrated into the node.
  Pose world_T_node = frame ? *frame : pcaFrame(part.world_points);
  if (!frame && p.frame == FrameChoice::world) world_T_node.setYawPitchRoll(0.0, 0.0, 0.0);
  const NodeId id = hierarchy_.add(part.label, NodeMap(p.resolution, p.occupancy), world_T_node, parent);
  MapNode& node = hierarchy_.node(id);
  node.first_scan = node.last_scan = node.version = z.scan;
  node.existence_log_odds = ExistenceFilter(p.existence).initialLogOdds();
  // What stands on something is held back until other views confirm it.
  node.confirmation.waits = part.structure == Structure::cluster && config_.confirm_scans > 1;
  if (node.confirmation.waits) {
    node.confirmation.points = part.points.size();
    waiting_.insert(id);
  }
  note(report, NodeEventKind::created, id, createdDetail(part.points.size(), z.scan, parent));
  return id;
}

void HierarchyMapper::updateMaps(const Measurement& z, const std::vector<LabelledPart*>& parts,
                                 const std::vector<NodeId>& nodes, UpdateReport& report) {
  // All segments of a node together, so that each voxel is updated once a scan.
  std::map<NodeId, NodeUpdate> by_node;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    PointIndices& points = by_node[nodes[i]].points;
    points.insert(points.end(), parts[i]->points.begin(), parts[i]->points.end());
  }
  std::vector<NodeUpdate> updates;
  for (auto& [id, update] : by_node) {
    update.node = &hierarchy_.node(id);
    update.world_T_node = hierarchy_.world_T_node(id);
    update.profile = &profile(update.node->label());
    update.max_range = smallerRange(config_.max_range, update.profile->max_range);
    update.bounded = config_.bounded;
    if (!std::is_sorted(update.points.begin(), update.points.end()))  // one segment is
      std::sort(update.points.begin(), update.points.end());
    if (config_.seam_votes) update.ceded = cededPoints(id, parts, nodes);
    updates.push_back(std::move(update));
  }
  std::vector<ScanUpdateReport> results(updates.size());
  forEachIndex(updates.size(), [&](std::size_t i) {
    results[i] = updateNodeMap(updates[i], z, *strategies_.update);
    // All that follows asks for the boxes of nodes, and but for the root's for their voxels: here in
    // parallel. A single map has no use for either.
    if (!config_.bounded) return;
    const MapNode& node = *updates[i].node;
    static_cast<void>(node.map().occupiedBox());
    if (node.id() != kRootId) static_cast<void>(node.map().occupiedVoxels());
  });

  std::vector<NodeId> created;
  for (std::size_t i = 0; i < updates.size(); ++i) {
    const MapNode& node = *updates[i].node;
    report.beyond_key_range += results[i].beyond_key_range;
    if (node.first_scan == z.scan && node.id() != kRootId) {
      created.push_back(node.id());
    } else {
      note(report, NodeEventKind::updated, node.id(), std::to_string(updates[i].points.size()) + " points");
    }
  }
  adoptRelated(created);
}

void HierarchyMapper::adoptRelated(const std::vector<NodeId>& created) {
  // An object that was seen before its table hangs under the background until the table appears.
  const RelationSet& relations = strategies_.relations;
  for (const NodeId above : created) {
    const Label& label = std::as_const(hierarchy_).node(above).label();
    if (std::none_of(profiles_.begin(), profiles_.end(),
                     [&](const auto& p) { return relations.mayHold(label, p.first); }))
      continue;
    for (const NodeId id : hierarchy_.ids()) {
      if (id != above && relations.adopts(hierarchy_, above, id)) hierarchy_.reparent(id, above);
    }
  }
}

const LabelProfile& HierarchyMapper::profile(const Label& label) const {
  const auto found = profiles_.find(label);
  if (found == profiles_.end()) {
    throw ConfigError("label '" + label.name + "' has no section [label." + label.name + "]");
  }
  return found->second;
}

}  // namespace hoctomap
