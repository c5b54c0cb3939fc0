// SPDX-License-Identifier: BSD-3-Clause
// Questions to a whole map: can a gripper come down on each object, and what does it meet?
//   example_03_query MAP
#include <hoctomap/io/MapReader.h>
#include <hoctomap/query/HierarchyQuery.h>

#include <iostream>

using namespace hoctomap;

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: example_03_query MAP\n";
    return 2;
  }
  try {
    const StoredMap stored = readMap(argv[1]);
    const MapHierarchy& map = stored.hierarchy;
    const HierarchyQuery query(map);  // made once; any number of threads may ask

    for (const NodeId id : map.ids()) {
      if (map.node(id).label() != labels::object) continue;
      const Eigen::AlignedBox3d bounds = worldBounds(map.box(id));

      // Straight down on the middle of it, from 30 cm above. What is unknown is no obstacle here.
      const Eigen::Vector3d above(bounds.center().x(), bounds.center().y(), bounds.max().z() + 0.3);
      const RayAnswer ray = query.castRay(above, -Eigen::Vector3d::UnitZ(), {.ignore_unknown = true});
      std::cout << "object " << id.value << ": from above a ray meets ";
      if (ray.node) {
        std::cout << map.node(*ray.node).label().name << " " << ray.node->value << " after " << ray.distance
                  << " m, the point is "
                  << (query.at(ray.point - 1e-6 * Eigen::Vector3d::UnitZ()).state == Occupancy::occupied
                          ? "occupied"
                          : "not occupied")
                  << "\n";
      } else {
        std::cout << "nothing\n";
      }

      // A gripper of 8 x 8 x 10 cm, 5 cm over the object.
      Obb gripper;
      gripper.world_T_frame.translation() << above.x(), above.y(), bounds.max().z() + 0.1;
      gripper.box =
          Eigen::AlignedBox3d(Eigen::Vector3d(-0.04, -0.04, -0.05), Eigen::Vector3d(0.04, 0.04, 0.05));
      const auto obstacle = query.collision(gripper);
      const auto nearest = query.nearestOccupied(gripper.center());
      std::cout << "  a gripper over it is " << (obstacle ? "not free" : "free") << ", "
                << 100.0 * query.unknownShare(gripper) << " % of its room is unknown, the nearest surface is "
                << (nearest ? nearest->distance : 0.0) << " m from its middle\n";
    }
  } catch (const std::exception& e) {
    std::cerr << e.what() << "\n";
    return 1;
  }
}
