// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

#include "hoctomap/mapping/HierarchyMapper.h"
#include "support/RandomScenes.h"

// A mapper whose segmentation and evidence the test dictates.
namespace hoctomap::test {

/// A piece of a scan whose structure is known: the segmentation of these tests reads it off.
struct Piece {
  Structure structure;
  PointCloud points;
};

/// A scan made of pieces, and the segmentation that takes it apart again.
struct Scan {
  Measurement z;
  std::vector<Segment> segments;

  Scan(std::uint64_t number, const std::vector<Piece>& pieces, const Eigen::Vector3d& origin = {0, 0, 2}) {
    z.scan = number;
    z.stamp = 100.0 + static_cast<double>(number);
    z.world_T_sensor = Pose(origin.x(), origin.y(), origin.z(), 0, 0, 0);
    for (const Piece& piece : pieces) {
      Segment segment;
      segment.structure = piece.structure;
      for (std::size_t i = 0; i < piece.points.size(); ++i)
        segment.points.push_back(static_cast<std::uint32_t>(z.world_points.size() + i));
      z.world_points.insert(z.world_points.end(), piece.points.begin(), piece.points.end());
      segments.push_back(std::move(segment));
    }
  }
};

/// Evidence that the test dictates, by node.
class DictatedEvidence : public InverseExistenceModel {
 public:
  explicit DictatedEvidence(std::shared_ptr<std::map<NodeId, Evidence>> by_node)
      : by_node_(std::move(by_node)) {}
  [[nodiscard]] std::vector<Evidence> evidence(const MapHierarchy&, const Measurement&,
                                               const std::vector<NodeInQuestion>& nodes) const override {
    std::vector<Evidence> result;
    for (const NodeInQuestion& node : nodes) result.push_back((*by_node_)[node.id]);
    return result;
  }

 private:
  std::shared_ptr<std::map<NodeId, Evidence>> by_node_;
};

inline LabelProfiles profiles() {
  LabelProfiles p;
  p[labels::background].resolution = 0.1;
  p[labels::background].frame = FrameChoice::world;
  p[labels::table].resolution = 0.05;
  p[labels::object].resolution = 0.01;
  return p;
}

/// A mapper with the paper's labels and relation, boxes for association, and whatever segmentation the scan
/// has.
struct Mapper {
  std::shared_ptr<const Scan*> current = std::make_shared<const Scan*>(nullptr);
  std::shared_ptr<std::map<NodeId, Evidence>> evidence = std::make_shared<std::map<NodeId, Evidence>>();
  HierarchyMapper mapper;

  explicit Mapper(const MappingConfig& config = {}) : mapper(config, profiles(), strategies()) {}

  MappingStrategies strategies() {
    MappingStrategies s;
    s.segmentation =
        makeSegmentation([current = current](const Measurement&) { return (*current)->segments; });
    s.labeling = makeLabeling([](const Measurement&, const Segment& segment) {
      return segment.structure == Structure::plane     ? labels::table
             : segment.structure == Structure::cluster ? labels::object
                                                       : labels::background;
    });
    s.association = makeAssociation([](const MapHierarchy& h, const LabelledSegment& segment,
                                       const Admissible& admissible) -> std::optional<NodeId> {
      for (const NodeId id : h.ids()) {
        if (h.node(id).label() == segment.label && admissible(id) && intersects(h.box(id), segment.box))
          return id;
      }
      return std::nullopt;
    });
    s.relations.add(makeRelation("supports", [](const NodeView& a, const NodeView& b) {
      return (a.label == labels::background && b.label != labels::background) ||
             (a.label == labels::table && b.label == labels::object);
    }));
    s.existence = std::make_unique<DictatedEvidence>(evidence);
    return s;
  }

  UpdateReport integrate(const Scan& scan) {
    *current = &scan;
    return mapper.integrate(scan.z);
  }
  [[nodiscard]] const MapHierarchy& h() const { return mapper.hierarchy(); }
};

inline PointCloud patch(double x, double y, double z, double half_x, double half_y, double half_z,
                        std::uint64_t seed = 1) {
  test::Rng rng(seed);
  PointCloud points;
  for (int i = 0; i < 300; ++i) {
    points.push_back(Eigen::Vector3d(x + test::uniform(rng, -half_x, half_x),
                                     y + test::uniform(rng, -half_y, half_y),
                                     z + test::uniform(rng, -half_z, half_z))
                         .cast<float>());
  }
  return points;
}

inline const Piece kFloor{Structure::remainder, patch(0, 0, 0, 2, 2, 0.01)};
inline const Piece kTable{Structure::plane, patch(0, 0, 0.7, 0.5, 0.4, 0.005)};
inline const Piece kCup{Structure::cluster, patch(0.2, 0.1, 0.75, 0.04, 0.03, 0.04)};
inline const Piece kBox{Structure::cluster, patch(-0.3, 0.0, 0.78, 0.05, 0.04, 0.07)};

inline Evidence seen(bool present) {
  Evidence e;
  e.present = present ? 100 : 0;
  e.absent = present ? 0 : 100;
  e.informative = true;
  e.p_measurement = present ? 0.9 : 0.1;
  return e;
}

inline std::string otBytes(const NodeMap& map) {
  std::ostringstream out;
  map.tree().write(out);
  return out.str();
}

inline std::size_t count(const UpdateReport& report, NodeEventKind kind) {
  return static_cast<std::size_t>(std::count_if(report.events.begin(), report.events.end(),
                                                [kind](const auto& e) { return e.kind == kind; }));
}

}  // namespace hoctomap::test
