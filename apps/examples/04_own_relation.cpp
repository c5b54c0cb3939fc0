// SPDX-License-Identifier: BSD-3-Clause
// An own relation and an own segmentation: shelves *contain* boxes. Prints the tree it makes.
#include <hoctomap/mapping/HierarchyMapper.h>

#include <iostream>
#include <string>

using namespace hoctomap;

namespace {

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

/// S: what lies deeper than 1.9 m belongs to the shelf, what lies before it to the things in it, left and
/// right.
std::vector<Segment> segmentShelf(const Measurement& z) {
  std::vector<Segment> segments(3);
  segments[0].structure = Structure::plane;
  segments[1].structure = segments[2].structure = Structure::cluster;
  for (std::uint32_t i = 0; i < z.world_points.size(); ++i) {
    const auto& p = z.world_points[i];
    const bool is_thing = std::abs(std::abs(p.y()) - 0.3F) < 0.15F && std::abs(p.z()) < 0.15F;
    segments[is_thing ? (p.y() < 0.0F ? 1U : 2U) : 0U].points.push_back(i);
  }
  return segments;
}

}  // namespace

int main() {
  const Label shelf{"shelf"};
  MappingStrategies strategies;
  strategies.segmentation = makeSegmentation(segmentShelf);
  strategies.labeling = makeLabeling([shelf](const Measurement&, const Segment& s) {
    return s.structure == Structure::plane ? shelf : labels::object;
  });
  strategies.association =
      makeAssociation([](const MapHierarchy& h, const LabelledSegment& segment, const Admissible&) {
        for (const NodeId id : h.ids()) {
          if (h.node(id).label() == segment.label && intersects(h.box(id), segment.box))
            return std::optional(id);
        }
        return std::optional<NodeId>();
      });
  // r: a node contains another whose centre lies in its box.
  strategies.relations.add(makeRelation("contains", [](const NodeView& above, const NodeView& below) {
    return above.box.contains(below.box.center());
  }));

  LabelProfiles profiles;
  profiles[labels::background].resolution = 0.1;
  profiles[shelf].resolution = 0.02;
  profiles[labels::object].resolution = 0.005;
  HierarchyMapper mapper({}, profiles, std::move(strategies));

  Measurement z;  // seen from the origin, looking along x
  addBox(z.world_points, {2.0F, 0.0F, 0.0F}, {0.2F, 0.7F, 0.3F});
  addBox(z.world_points, {2.0F, -0.3F, 0.0F}, {0.05F, 0.08F, 0.1F});
  addBox(z.world_points, {2.0F, 0.3F, 0.0F}, {0.08F, 0.05F, 0.12F});
  mapper.integrate(z);

  const MapHierarchy& map = mapper.hierarchy();
  for (const NodeId id : map.preorder()) {
    std::cout << std::string(2 * map.depth(id), ' ') << map.node(id).label().name << " " << id.value << ", "
              << map.node(id).map().countVoxels().occupied << " occupied voxels\n";
  }
}
