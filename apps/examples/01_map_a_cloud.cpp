// SPDX-License-Identifier: BSD-3-Clause
// From a point cloud to a hierarchy: a table with a parcel on it, taken apart and mapped as Section IV does.
#include <hoctomap/mapping/HierarchyMapper.h>
#include <hoctomap/octree/BlockScanUpdate.h>
#include <hoctomap/tabletop/Tabletop.h>
#include <hoctomap/tabletop/TabletopSegmentation.h>

#include <iostream>

using namespace hoctomap;

namespace {

/// Points every 4 mm of the rectangle at `corner` with these two sides.
void addFace(PointCloud& cloud, Eigen::Vector3f corner, Eigen::Vector3f a, Eigen::Vector3f b) {
  constexpr float kStep = 0.004F;
  for (float s = 0.0F; s <= 1.0F; s += kStep / a.norm()) {
    for (float t = 0.0F; t <= 1.0F; t += kStep / b.norm()) cloud.push_back(corner + s * a + t * b);
  }
}

}  // namespace

int main() {
  // The scan: points in the world, and where the sensor was. Yours may come from anywhere.
  Measurement z;
  z.world_T_sensor = Pose(0.5, -1.0, 1.6, 0.0, 0.0, 0.0);
  addFace(z.world_points, {0.0F, 0.0F, 0.7F}, {1.0F, 0.0F, 0.0F}, {0.0F, 0.8F, 0.0F});     // table top
  addFace(z.world_points, {0.4F, 0.3F, 0.704F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.15F});  // parcel, front
  addFace(z.world_points, {0.4F, 0.3F, 0.85F}, {0.2F, 0.0F, 0.0F}, {0.0F, 0.15F, 0.0F});   // parcel, top

  // The framework's exchangeable parts: S, L, R and f_A of Section IV.
  MappingStrategies strategies;
  strategies.segmentation = std::make_unique<TabletopSegmentation>(TabletopSegmentationConfig{});
  strategies.labeling = makeTabletopLabeling();
  strategies.relations = makeTabletopRelations();
  strategies.association = makeTabletopAssociation(0.0);
  strategies.update = makeBlockScanUpdate();

  LabelProfiles profiles;
  profiles[labels::background].resolution = 0.05;
  profiles[labels::table].resolution = 0.01;
  profiles[labels::object].resolution = 0.004;

  HierarchyMapper mapper({}, profiles, std::move(strategies));
  for (const NodeEvent& event : mapper.integrate(z).events) {
    std::cout << event.label.name << " " << event.node.value << " " << toString(event.kind) << ": "
              << event.detail << "\n";
  }
}
