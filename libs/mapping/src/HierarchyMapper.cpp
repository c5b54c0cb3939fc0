// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/HierarchyMapper.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "ContestedNodes.h"
#include "MovedObjects.h"
#include "NodeUpdate.h"
#include "PieceVoting.h"
#include "hoctomap/geometry/Errors.h"
#include "hoctomap/geometry/PcaFrame.h"

namespace hoctomap {

namespace {

/// Adds the wall time of a scope to a stage.
class StageTimer {
 public:
  explicit StageTimer(double& seconds) : seconds_(seconds), start_(Clock::now()) {}
  ~StageTimer() { seconds_ += std::chrono::duration<double>(Clock::now() - start_).count(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  double& seconds_;
  Clock::time_point start_;
};

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

}  // namespace

struct HierarchyMapper::NodeEvidence {
  std::map<NodeId, Evidence> by_node;

  [[nodiscard]] bool contradicts(NodeId id) const {
    const auto found = by_node.find(id);
    return found != by_node.end() && found->second.contradicts();
  }
};

HierarchyMapper::HierarchyMapper(MappingConfig config, LabelProfiles profiles, MappingStrategies strategies)
    : HierarchyMapper(config, profiles, std::move(strategies), makeRoot(profiles)) {}

HierarchyMapper::HierarchyMapper(MappingConfig config, LabelProfiles profiles, MappingStrategies strategies,
                                 MapHierarchy hierarchy)
    : config_(config),
      profiles_(std::move(profiles)),
      strategies_(std::move(strategies)),
      hierarchy_(std::move(hierarchy)) {}

UpdateReport HierarchyMapper::integrate(const Measurement& z, PreparedScan prepared) {
  UpdateReport report;
  report.scan = z.scan;
  report.stamp = z.stamp;
  report.points = z.world_points.size();

  // III-C, step 1: segments with their labels.
  std::vector<LabelledPart>& parts = prepared.parts;
  report.seconds.segment = prepared.seconds;

  // What the whole measurement says of the nodes, before anything of it is integrated (III-D).
  NodeEvidence evidence;
  {
    const StageTimer timer(report.seconds.existence);
    evidence = gatherEvidence(z);
  }

  // The background first, then planes, then clusters: so that parents exist when their children come.
  for (const Structure structure : {Structure::remainder, Structure::plane, Structure::cluster}) {
    std::vector<LabelledPart*> group;
    for (auto& part : parts) {
      if (part.structure == structure) group.push_back(&part);
    }
    // Step 2: associate each segment to a node, or create one.
    std::vector<NodeId> nodes;
    {
      const StageTimer timer(report.seconds.associate);
      nodes = associate(z, group, evidence, report);
    }
    // Step 3: update the nodes' maps.
    const StageTimer timer(report.seconds.update);
    updateMaps(z, group, nodes, report);
  }

  // Nodes that turn out to be pieces of others join them.
  mergePieces(z, parts, evidence, report);

  // Eq. 8: nodes whose probability of existence falls below 0.5 are removed.
  const StageTimer timer(report.seconds.existence);
  applyExistence(z, evidence, report);
  return report;
}

PreparedScan HierarchyMapper::prepare(const Measurement& z) const {
  PreparedScan prepared;
  double seconds = 0.0;
  {
    const StageTimer timer(seconds);
    prepared.parts = segmentAndLabel(z);
  }
  prepared.seconds = seconds;
  return prepared;
}

std::vector<LabelledPart> HierarchyMapper::segmentAndLabel(const Measurement& z) const {
  std::vector<Segment> segments = strategies_.segmentation->segment(z);
  std::vector<LabelledPart> parts;
  parts.reserve(segments.size());
  for (Segment& segment : segments) {
    if (segment.points.empty()) continue;
    LabelledPart part{segment.structure, {}, {}, strategies_.labeling->label(z, segment), {}, {}};
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
  std::vector<NodeId> nodes;
  std::vector<ExistenceParameters> parameters;
  for (const NodeId id : hierarchy_.idsNear(strategies_.existence->reach(z))) {
    const LabelProfile& p = profile(hierarchy_.node(id).label());
    if (id == kRootId || !p.existence_enabled) continue;
    nodes.push_back(id);
    parameters.push_back(p.existence);
  }
  const auto evidence = strategies_.existence->evidence(hierarchy_, z, nodes, parameters);
  for (std::size_t i = 0; i < nodes.size(); ++i) gathered.by_node[nodes[i]] = evidence[i];
  return gathered;
}

std::vector<NodeId> HierarchyMapper::associate(const Measurement& z, const std::vector<LabelledPart*>& parts,
                                               NodeEvidence& evidence, UpdateReport& report) {
  // A node that this scan contradicts must not swallow what has moved into its box.
  const Admissible admissible = [&evidence](NodeId id) { return !evidence.contradicts(id); };
  std::vector<std::optional<NodeId>> found;
  for (const LabelledPart* part : parts) {
    found.push_back(strategies_.association->associate(
        hierarchy_, LabelledSegment{part->label, &part->world_points, part->box}, admissible));
    // There is one background, whether or not any of it has been seen.
    if (!found.back() && part->label == hierarchy_.root().label()) found.back() = kRootId;
  }
  followMovedObjects(z, parts, found, evidence, report);
  std::vector<NodeId> nodes;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    nodes.push_back(found[i] ? *found[i] : createNode(z, *parts[i], report));
    parts[i]->node = nodes.back();
  }
  return nodes;
}

void HierarchyMapper::followMovedObjects(const Measurement& z, const std::vector<LabelledPart*>& parts,
                                         std::vector<std::optional<NodeId>>& found, NodeEvidence& evidence,
                                         UpdateReport& report) {
  if (parts.empty() || parts.front()->structure != Structure::cluster) return;
  std::vector<SegmentInQuestion> segments;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    segments.push_back({parts[i]->label, &parts[i]->world_points, found[i]});
  }
  if (config_.contest_at_surface) releaseStrangers(hierarchy_, segments);
  for (std::size_t i = 0; i < parts.size(); ++i) found[i] = segments[i].node;
  MovedObjects moved = findMovedObjects(hierarchy_, z, segments, evidence.by_node, config_.reidentification);
  for (const MovedObject& object : moved.found) {
    const Eigen::Isometry3d world_T_node = toIsometry(hierarchy_.world_T_node(object.node));
    // III-D: t_i <- t_i o t, with t in the node's frame.
    hierarchy_.move(
        object.node,
        poseFromMatrix((world_T_node.inverse() * object.registration.motion * world_T_node).matrix()));
    MapNode& node = hierarchy_.node(object.node);
    hierarchy_.reparent(object.node, strategies_.relations.deepestAncestor(
                                         hierarchy_, hierarchy_.view(object.node), &object.node));
    found[object.segment] = object.node;
    // The scan shows the node, although not where it was.
    Evidence& e = evidence.by_node.at(object.node);
    std::swap(e.present, e.absent);
    e.p_measurement = profile(node.label()).existence.p_present;
    report.events.push_back({NodeEventKind::reidentified, node.id(), node.label(), node.existence(),
                             poseFromMatrix(object.registration.motion.matrix()).asString() + " score " +
                                 std::to_string(object.registration.score).substr(0, 5)});
  }
  report.warnings.insert(report.warnings.end(), moved.ambiguous.begin(), moved.ambiguous.end());
}

NodeId HierarchyMapper::createNode(const Measurement& z, const LabelledPart& part, UpdateReport& report) {
  const LabelProfile& p = profile(part.label);
  const NodeId parent = strategies_.relations.deepestAncestor(hierarchy_, {part.label, part.box, nullptr});
  // IV-A: the frame comes from the first measurement that is integrated into the node.
  Pose world_T_node = pcaFrame(part.world_points);
  if (p.frame == FrameChoice::world) world_T_node.setYawPitchRoll(0.0, 0.0, 0.0);
  const NodeId id = hierarchy_.add(part.label, NodeMap(p.resolution, p.occupancy), world_T_node, parent);
  MapNode& node = hierarchy_.node(id);
  node.first_scan = node.last_scan = node.version = z.scan;
  node.existence_log_odds = ExistenceFilter(p.existence).initialLogOdds();
  report.events.push_back(
      {NodeEventKind::created, id, part.label, node.existence(),
       std::to_string(part.points.size()) + " points, parent " + std::to_string(parent.value)});
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
    updates.push_back(std::move(update));
  }
  std::vector<ScanUpdateReport> results(updates.size());
  tbb::parallel_for(std::size_t{0}, updates.size(), [&](std::size_t i) {
    results[i] = updateNodeMap(updates[i], z, *strategies_.update);
    static_cast<void>(
        updates[i].node->map().occupiedBox());  // all that follows asks for it: here in parallel
  });

  std::vector<NodeId> created;
  for (std::size_t i = 0; i < updates.size(); ++i) {
    const MapNode& node = *updates[i].node;
    report.beyond_key_range += results[i].beyond_key_range;
    if (node.first_scan == z.scan && node.id() != kRootId) {
      created.push_back(node.id());
    } else {
      report.events.push_back({NodeEventKind::updated, node.id(), node.label(), node.existence(),
                               std::to_string(updates[i].points.size()) + " points"});
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

void HierarchyMapper::mergePieces(const Measurement& z, const std::vector<LabelledPart>& parts,
                                  const NodeEvidence& evidence, UpdateReport& report) {
  std::vector<TakenSegment> taken;
  for (const LabelledPart& part : parts) taken.push_back({part.node, &part.world_points});
  for (const auto& [piece, e] : evidence.by_node) {
    const auto whole = voteOnPiece(hierarchy_, piece, e, taken);
    if (!whole) continue;
    MapNode& merged = hierarchy_.node(*whole);
    const Pose world_T_piece = hierarchy_.world_T_node(piece);
    merged.map().absorb(hierarchy_.node(piece).map(),
                        toIsometry(-hierarchy_.world_T_node(*whole) + world_T_piece));
    merged.version = z.scan;
    merged.first_scan = std::min(merged.first_scan, hierarchy_.node(piece).first_scan);
    removed_.push_back({hierarchy_.remove(piece), world_T_piece, z.scan});
    const MapNode& gone = removed_.back().node;
    report.events.push_back({NodeEventKind::merged, piece, gone.label(), gone.existence(),
                             "into node " + std::to_string(whole->value)});
  }
}

void HierarchyMapper::applyExistence(const Measurement& z, const NodeEvidence& evidence,
                                     UpdateReport& report) {
  for (const auto& [id, e] : evidence.by_node) {
    if (e.present + e.absent + e.occluded == 0 || !hierarchy_.contains(id)) {
      continue;  // out of view, or merged just now
    }
    MapNode& node = hierarchy_.node(id);
    if (e.informative) {
      const ExistenceFilter filter(profile(node.label()).existence);
      node.existence_log_odds = filter.update(node.existence_log_odds, e.p_measurement);
    }
    report.existence.push_back({node.id(), e, node.existence()});
  }
  for (const auto& [id, e] : evidence.by_node) {
    if (!hierarchy_.contains(id) || !ExistenceFilter::isGone(hierarchy_.node(id).existence_log_odds))
      continue;
    const Pose world_T_node = hierarchy_.world_T_node(id);
    removed_.push_back({hierarchy_.remove(id), world_T_node, z.scan});
    const MapNode& node = removed_.back().node;
    report.events.push_back(
        {NodeEventKind::removed, id, node.label(), node.existence(), "existence below 0.5"});
  }
}

UpdateReport HierarchyMapper::integrate(const ObjectMotion& motion, std::uint64_t scan) {
  UpdateReport report;
  report.scan = scan;
  report.stamp = motion.stamp;
  if (!hierarchy_.contains(motion.node) || motion.node == kRootId) {
    report.warnings.push_back("motion of node " + std::to_string(motion.node.value) +
                              " ignored: there is no such movable node");
    return report;
  }
  hierarchy_.move(motion.node, motion.motion);  // t_i <- t_i o t
  const MapNode& node = hierarchy_.node(motion.node);
  report.events.push_back(
      {NodeEventKind::moved, node.id(), node.label(), node.existence(), motion.motion.asString()});
  return report;
}

const LabelProfile& HierarchyMapper::profile(const Label& label) const {
  const auto found = profiles_.find(label);
  if (found == profiles_.end()) {
    throw ConfigError("label '" + label.name + "' has no section [label." + label.name + "]");
  }
  return found->second;
}

}  // namespace hoctomap
