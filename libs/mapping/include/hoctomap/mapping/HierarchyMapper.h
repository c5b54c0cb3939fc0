// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hoctomap/existence/InverseExistenceModel.h"
#include "hoctomap/hierarchy/MapHierarchy.h"
#include "hoctomap/mapping/AssociationFunction.h"
#include "hoctomap/mapping/LabelProfile.h"
#include "hoctomap/mapping/LabelingFunction.h"
#include "hoctomap/mapping/LateMatches.h"
#include "hoctomap/mapping/MeasurementSource.h"
#include "hoctomap/mapping/PreparedScan.h"
#include "hoctomap/mapping/Reidentification.h"
#include "hoctomap/mapping/SeamVotes.h"
#include "hoctomap/mapping/Segmentation.h"
#include "hoctomap/mapping/StillSensor.h"
#include "hoctomap/mapping/UpdateReport.h"

namespace hoctomap {

/// The exchangeable parts of the framework (Section III): S, L, f_A, R and P(n | z_t), and the update engine.
struct MappingStrategies {
  std::unique_ptr<Segmentation> segmentation;
  std::unique_ptr<LabelingFunction> labeling;
  std::unique_ptr<AssociationFunction> association;
  RelationSet relations;
  std::unique_ptr<InverseExistenceModel> existence;  ///< null: nodes are never removed
  std::unique_ptr<ScanUpdate> update = makeReferenceScanUpdate();
};

struct MappingConfig {
  double max_range = -1.0;  ///< m, of the sensor; negative: no limit
  bool bounded = true;      ///< clip beams to the node's box (IV-B); false only for the monolithic map
  bool contest_at_surface = false;  ///< of several segments in a node's box, those at its surface join it
  ReidentificationConfig reidentification;
  /// Scans that must show a cluster before its node enters the map; until then it is held back.
  std::uint64_t confirm_scans = 1;
  /// What a node is goes by surfaces and by the votes of all scans on where objects meet (SeamVotes).
  bool seam_votes = false;
};

struct MovedObjects;
class ScanSight;
class SurfaceRegions;
class NodeRegions;

/// Builds a hierarchy from measurements: the map update of Section III-C.
class HierarchyMapper {
 public:
  /// @throws ConfigError if there is no profile for the root's label.
  HierarchyMapper(MappingConfig config, LabelProfiles profiles, MappingStrategies strategies);

  /// Continues an existing hierarchy.
  HierarchyMapper(MappingConfig config, LabelProfiles profiles, MappingStrategies strategies,
                  MapHierarchy hierarchy, SeamVotes seams = {},
                  std::optional<StillSensor> sensor = std::nullopt);

  /// Integrates one measurement.
  UpdateReport integrate(const Measurement& z) { return integrate(z, prepare(z)); }

  /// The part of the integration that does not look at the map: may run while another scan is integrated.
  [[nodiscard]] PreparedScan prepare(const Measurement& z) const;

  /// Integrates a measurement that has been prepared.
  UpdateReport integrate(const Measurement& z, PreparedScan prepared);

  /// Applies a perceived movement (Section III-D) before scan number `scan`. A movement of a node that does
  /// not exist (any more) changes nothing and is a warning of the report.
  UpdateReport integrate(const ObjectMotion& motion, std::uint64_t scan);

  /// The log has ended with scan `scan`: nodes that still wait for confirmation enter the map if enough
  /// speaks for them. Nothing may be integrated afterwards.
  UpdateReport finish(std::uint64_t scan, double stamp);

  /// Changes of the map by hand, between scans (HierarchyMapperEdits.cpp); to move is to integrate a motion.
  struct Edit {
    std::uint64_t scan = 0;    ///< the last one
    double stamp = 0.0;        ///< of it
    std::uint64_t number = 1;  ///< of the edit
  };
  /// Nodes that only the end of the log has let in are in the map for good.
  void confirmEntered();
  /// All three: @throws ConfigError if the map has no such node, or may not be changed like this.
  UpdateReport relabel(NodeId id, const Label& label, const Edit& edit);
  UpdateReport remove(NodeId id, const Edit& edit);
  /// `piece` goes into `whole`, its children go with it.
  UpdateReport merge(NodeId whole, NodeId piece, const Edit& edit);

  /// Nodes that wait for confirmation are in it (`MapNode::confirmation`).
  [[nodiscard]] const MapHierarchy& hierarchy() const { return hierarchy_; }
  /// What the scans say of where objects meet; belongs to the state of a map that is gone on with.
  [[nodiscard]] const SeamVotes& seams() const { return seams_; }
  /// The sensor of the last scan; belongs to that state as well. None before the first scan.
  [[nodiscard]] const std::optional<StillSensor>& sensor() const { return sensor_; }
  /// Nodes that were removed since the construction of the mapper, in order, with the world pose they had.
  [[nodiscard]] const std::vector<RemovedNode>& removed() const { return removed_; }

 private:
  struct NodeEvidence;

  std::vector<LabelledPart> segmentAndLabel(const Measurement& z) const;
  NodeEvidence gatherEvidence(const Measurement& z) const;
  std::vector<std::optional<NodeId>> associateByBox(const std::vector<LabelledPart*>& parts,
                                                    const NodeEvidence& evidence) const;
  std::vector<NodeId> associate(const Measurement& z, const std::vector<LabelledPart*>& parts,
                                const NodeEvidence& evidence, UpdateReport& report);
  NodeId createNode(const Measurement& z, const LabelledPart& part, UpdateReport& report,
                    const std::optional<Pose>& frame = std::nullopt);
  void updateMaps(const Measurement& z, const std::vector<LabelledPart*>& parts,
                  const std::vector<NodeId>& nodes, UpdateReport& report);
  /// The points of other nodes' segments in the box of a node of things, in its frame (docs/decisions/0029).
  [[nodiscard]] PointCloud cededPoints(NodeId id, const std::vector<LabelledPart*>& parts,
                                       const std::vector<NodeId>& nodes) const;
  void adoptRelated(const std::vector<NodeId>& created);
  // HierarchyMapperChanges.cpp
  void followMovedObjects(const Measurement& z, std::vector<LabelledPart>& parts, NodeEvidence& evidence,
                          UpdateReport& report);
  void findReplaced(const Measurement& z, const std::vector<LabelledPart*>& clusters,
                    NodeEvidence& evidence) const;
  MovedObjects findMoved(const Measurement& z, const ScanSight& sight,
                         const std::vector<LabelledPart*>& clusters, const NodeEvidence& evidence) const;
  void assumeWhole(NodeId id);
  void moveInWorld(NodeId id, const Eigen::Isometry3d& motion);
  void matchLate(const Measurement& z, NodeEvidence& evidence, UpdateReport& report);
  void mergePieces(const Measurement& z, const std::vector<LabelledPart>& parts, const NodeEvidence& evidence,
                   UpdateReport& report);
  [[nodiscard]] bool meet(NodeId a, NodeId b) const;
  void mergeInto(NodeId whole, NodeId piece, std::uint64_t scan, UpdateReport& report);
  void applyExistence(const Measurement& z, const NodeEvidence& evidence, UpdateReport& report);
  // HierarchyMapperIdentity.cpp
  void settleIdentity(const Measurement& z, PreparedScan& prepared, const NodeEvidence& evidence,
                      UpdateReport& report);
  [[nodiscard]] bool isOfKind(NodeId id, const Label& label) const;
  /// The largest of the parts of one thing keeps its id, of equals the oldest.
  void keepLargestFirst(std::vector<NodeId>& owners) const;
  void mergeBridged(const Measurement& z, const std::vector<LabelledPart>& parts, UpdateReport& report);
  void mergeOwners(const Measurement& z, const SurfaceRegions& regions, NodeRegions& held,
                   std::vector<LabelledPart>& parts, UpdateReport& report);
  void splitHolders(const Measurement& z, const SurfaceRegions& regions, NodeRegions& held,
                    UpdateReport& report);
  void handOver(const Measurement& z, NodeId from, NodeId to, std::uint32_t region,
                const SurfaceRegions& regions);
  NodeId splitOff(const Measurement& z, NodeId id, std::uint32_t region, const SurfaceRegions& regions,
                  UpdateReport& report);
  void divideSegments(const SurfaceRegions& regions, const NodeRegions& held, const std::set<NodeId>& near,
                      std::vector<LabelledPart>& parts) const;
  [[nodiscard]] std::optional<NodeId> nodeOf(std::uint32_t region, const LabelledPart& part,
                                             const SurfaceRegions& regions, const NodeRegions& held,
                                             const std::set<NodeId>& near) const;
  // HierarchyMapperEdits.cpp
  void requireEditable(NodeId id) const;
  // HierarchyMapperConfirmation.cpp
  void confirmNodes(const std::vector<LabelledPart>& parts, const NodeEvidence& evidence,
                    UpdateReport& report);
  void enterMap(NodeId id, UpdateReport& report);
  void takeOut(NodeId id, std::uint64_t scan);
  void note(UpdateReport& report, NodeEventKind kind, NodeId id, std::string detail) const;
  [[nodiscard]] const LabelProfile& profile(const Label& label) const;

  MappingConfig config_;
  LabelProfiles profiles_;
  MappingStrategies strategies_;
  MapHierarchy hierarchy_;
  std::vector<RemovedNode> removed_;
  SeamVotes seams_;
  std::optional<StillSensor> sensor_;
  LateMatches late_matches_;
  std::set<NodeId> waiting_;  ///< nodes that wait for confirmation
};

}  // namespace hoctomap
