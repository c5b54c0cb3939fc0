// SPDX-License-Identifier: BSD-3-Clause
// III-D: what has changed since the last scan. Moved, merged, replaced and removed nodes.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "MovedCarriers.h"
#include "NodeEvidence.h"
#include "PieceVoting.h"
#include "ReplacedObjects.h"
#include "SurfacePoints.h"

namespace hoctomap {

namespace {

std::string describe(const Registration& registration) {
  std::string text = poseFromMatrix(registration.motion.matrix()).asString() + " score " +
                     std::to_string(registration.score).substr(0, 5);
  for (const double turn : registration.other_turns)
    text +=
        ", or turned by " + std::to_string(std::lround(turn * 180.0 / std::numbers::pi)) + " degrees more";
  return text;
}

}  // namespace

void HierarchyMapper::followMovedObjects(const Measurement& z, std::vector<LabelledPart>& parts,
                                         NodeEvidence& evidence, UpdateReport& report) {
  const ReidentificationConfig& config = config_.reidentification;
  std::vector<LabelledPart*> clusters;
  for (auto& part : parts) {
    if (part.structure == Structure::cluster) clusters.push_back(&part);
  }
  if (!config.enabled || clusters.empty() || evidence.by_node.empty()) return;

  findReplaced(z, clusters, evidence);
  const ScanSight sight(z, config.registration.near, config.noise);
  MovedObjects moved = findMoved(z, sight, clusters, evidence);
  const auto carriers = findMovedCarriers(hierarchy_, moved.candidates, evidence.by_node, sight, config);
  if (!carriers.empty()) {
    for (const MovedCarrier& carrier : carriers) {
      moveInWorld(carrier.node, carrier.motion);
      Registration registration;
      registration.motion = carrier.motion;
      registration.score = carrier.score;
      note(report, NodeEventKind::reidentified, carrier.node, describe(registration));
    }
    evidence = gatherEvidence(z);  // what it says of them where they are now
    moved = findMoved(z, sight, clusters, evidence);
  }
  for (const MovedObject& object : moved.found) {
    moveInWorld(object.node, object.registration.motion);
    hierarchy_.reparent(object.node, strategies_.relations.deepestAncestor(
                                         hierarchy_, hierarchy_.view(object.node), &object.node));
    clusters[object.segment]->moved_node = object.node;
    evidence.support(object.node, profile(hierarchy_.node(object.node).label()).existence.p_present);
    note(report, NodeEventKind::reidentified, object.node, describe(object.registration));
  }
  report.warnings.insert(report.warnings.end(), moved.ambiguous.begin(), moved.ambiguous.end());
}

void HierarchyMapper::findReplaced(const Measurement& z, const std::vector<LabelledPart*>& clusters,
                                   NodeEvidence& evidence) const {
  const auto nodes = associateByBox(clusters, evidence);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const LabelledPart& part = *clusters[i];
    const double range = (part.world_points.front().cast<double>() - z.origin()).norm();
    for (const NodeId id : hierarchy_.idsNear(worldBounds(part.box))) {
      const auto found = evidence.by_node.find(id);
      if (found == evidence.by_node.end() || !found->second.informative) continue;
      const Evidence& e = found->second;
      // Either the segment would join the node, or one that was made after the node had its last: its
      // successor. Or it is new, because some beams contradict the node already.
      const bool is_candidate =
          nodes[i] ? *nodes[i] == id || hierarchy_.node(*nodes[i]).first_scan > hierarchy_.node(id).last_scan
                   : e.contradicts();
      if (!is_candidate) continue;
      // What nearly all beams end on is there, though other segments may join or divide it.
      if (e.presentShare() >= config_.reidentification.most_present) continue;
      if (hierarchy_.node(id).label() != part.label) continue;
      if (isReplaced(hierarchy_, id, part.world_points, range, config_.reidentification)) {
        evidence.contradict(id, profile(part.label).existence.p_absent);
      }
    }
  }
}

MovedObjects HierarchyMapper::findMoved(const Measurement& z, const ScanSight& sight,
                                        const std::vector<LabelledPart*>& clusters,
                                        const NodeEvidence& evidence) const {
  const auto nodes = associateByBox(clusters, evidence);
  std::vector<SegmentInQuestion> segments;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    segments.push_back({clusters[i]->label, &clusters[i]->world_points, nodes[i]});
  }
  return findMovedObjects(hierarchy_, z.origin(), sight, segments, evidence.by_node,
                          config_.reidentification);
}

void HierarchyMapper::moveInWorld(NodeId id, const Eigen::Isometry3d& motion) {
  // III-D: t_i <- t_i o t, with t in the node's frame.
  const Eigen::Isometry3d world_T_node = toIsometry(hierarchy_.world_T_node(id));
  hierarchy_.move(id, poseFromMatrix((world_T_node.inverse() * motion * world_T_node).matrix()));
  assumeWhole(id);
}

void HierarchyMapper::assumeWhole(NodeId id) {
  if (!config_.seam_votes) return;
  if (hierarchy_.node(id).label() != labels::table)
    seams_.assume(SeamVotes::cellsOf(worldSurface(hierarchy_, id)));
  for (const NodeId child : hierarchy_.node(id).children()) assumeWhole(child);
}

void HierarchyMapper::matchLate(const Measurement& z, NodeEvidence& evidence, UpdateReport& report) {
  std::vector<NodeId> contradicted;
  for (const auto& [id, e] : evidence.by_node) {
    if (e.contradicts() && hierarchy_.contains(id)) contradicted.push_back(id);
  }
  for (const NodeId id : contradicted) {
    const auto match = late_matches_.find(hierarchy_, id, z.scan, evidence.by_node, config_.reidentification);
    if (!match) continue;
    moveInWorld(id, match->registration.motion);
    hierarchy_.reparent(id, hierarchy_.node(match->again).parent().value_or(kRootId));
    evidence.support(id, profile(hierarchy_.node(id).label()).existence.p_present);
    note(report, NodeEventKind::reidentified, id, describe(match->registration));
    mergeInto(id, match->again, z.scan, report);
  }
}

void HierarchyMapper::mergePieces(const Measurement& z, const std::vector<LabelledPart>& parts,
                                  const NodeEvidence& evidence, UpdateReport& report) {
  std::vector<TakenSegment> taken;
  for (const LabelledPart& part : parts) taken.push_back({part.node, &part.world_points, part.joined_with});
  for (const auto& [piece, e] : evidence.by_node) {
    const auto whole = voteOnPiece(hierarchy_, piece, e, taken);
    if (!whole || meet(*whole, piece)) continue;
    mergeInto(*whole, piece, z.scan, report);
  }
}

bool HierarchyMapper::meet(NodeId a, NodeId b) const {
  if (!config_.seam_votes) return false;
  const auto cells = [this](NodeId id) { return SeamVotes::cellsOf(worldSurface(hierarchy_, id)); };
  return seams_.meet(cells(a), cells(b));
}

void HierarchyMapper::mergeInto(NodeId whole, NodeId piece, std::uint64_t scan, UpdateReport& report) {
  MapNode& merged = hierarchy_.node(whole);
  // Two views of a thing, or a piece that is confirmed: so is the whole.
  if (merged.confirmation.waits && !hierarchy_.node(piece).confirmation.waits) enterMap(whole, report);
  const Pose world_T_piece = hierarchy_.world_T_node(piece);
  merged.map().absorb(hierarchy_.node(piece).map(),
                      toIsometry(-hierarchy_.world_T_node(whole) + world_T_piece));
  merged.version = scan;
  merged.first_scan = std::min(merged.first_scan, hierarchy_.node(piece).first_scan);
  merged.last_scan = std::max(merged.last_scan, hierarchy_.node(piece).last_scan);
  const std::vector<NodeId> children = hierarchy_.node(piece).children();
  for (const NodeId child : children) {  // one of them may hold the whole: it goes to the piece's parent
    if (!hierarchy_.isInSubtree(whole, child)) hierarchy_.reparent(child, whole);
  }
  note(report, NodeEventKind::merged, piece, "into node " + std::to_string(whole.value));
  takeOut(piece, scan);
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
    if (!node.confirmation.waits) report.existence.push_back({node.id(), e, node.existence()});
  }
  for (const auto& [id, e] : evidence.by_node) {
    if (!hierarchy_.contains(id) || !ExistenceFilter::isGone(hierarchy_.node(id).existence_log_odds))
      continue;
    note(report, NodeEventKind::removed, id, "existence below 0.5");
    if (config_.seam_votes) seams_.forget(SeamVotes::cellsOf(worldSurface(hierarchy_, id)));
    takeOut(id, z.scan);
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
  assumeWhole(motion.node);
  note(report, NodeEventKind::moved, motion.node, motion.motion.asString());
  return report;
}

}  // namespace hoctomap
