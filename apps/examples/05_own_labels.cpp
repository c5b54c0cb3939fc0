// SPDX-License-Identifier: BSD-3-Clause
// Own labels, each with its resolution and sensor model: what is flat is a book, what is high is a bottle.
#include <hoctomap/mapping/HierarchyMapper.h>

#include <iostream>

using namespace hoctomap;

namespace {

const Label kBook{"book"};
const Label kBottle{"bottle"};

/// Points on the surface of a box.
void addBox(PointCloud& cloud, Eigen::Vector3f center, Eigen::Vector3f half) {
  for (float a = -1.0F; a <= 1.0F; a += 0.1F) {
    for (float b = -1.0F; b <= 1.0F; b += 0.1F) {
      for (const float side : {-1.0F, 1.0F}) {
        cloud.push_back(center + half.cwiseProduct(Eigen::Vector3f(side, a, b)));
        cloud.push_back(center + half.cwiseProduct(Eigen::Vector3f(a, side, b)));
        cloud.push_back(center + half.cwiseProduct(Eigen::Vector3f(a, b, side)));
      }
    }
  }
}

/// S: what is left and what is right of the middle are two things.
std::vector<Segment> leftAndRight(const Measurement& z) {
  std::vector<Segment> segments(2);
  for (Segment& segment : segments) segment.structure = Structure::cluster;
  for (std::uint32_t i = 0; i < z.world_points.size(); ++i) {
    segments[z.world_points[i].y() < 0.0F ? 0U : 1U].points.push_back(i);
  }
  return segments;
}

/// L: by how high the segment is, in the world.
Label byHeight(const Measurement& z, const Segment& segment) {
  Eigen::AlignedBox3f box;
  for (const std::uint32_t i : segment.points) box.extend(z.world_points[i]);
  return box.sizes().z() > box.sizes().head<2>().maxCoeff() ? kBottle : kBook;
}

}  // namespace

int main() {
  MappingStrategies strategies;
  strategies.segmentation = makeSegmentation(leftAndRight);
  strategies.labeling = makeLabeling(byHeight);
  strategies.association = makeAssociation(
      [](const MapHierarchy&, const LabelledSegment&, const Admissible&) { return std::optional<NodeId>(); });

  LabelProfiles profiles;
  profiles[labels::background].resolution = 0.05;
  profiles[kBook].resolution = 0.01;
  profiles[kBottle].resolution = 0.002;        // is to be grasped
  profiles[kBottle].occupancy.prob_hit = 0.9;  // and shows well
  HierarchyMapper mapper({}, profiles, std::move(strategies));

  Measurement z;
  addBox(z.world_points, {1.0F, -0.3F, 0.02F}, {0.1F, 0.15F, 0.02F});
  addBox(z.world_points, {1.0F, 0.3F, 0.15F}, {0.04F, 0.04F, 0.15F});
  mapper.integrate(z);

  for (const NodeId id : mapper.hierarchy().ids()) {
    const MapNode& node = mapper.hierarchy().node(id);
    std::cout << id.value << " " << node.label().name << " at " << node.map().resolution()
              << " m, hits count " << node.map().model().prob_hit << "\n";
  }
}
