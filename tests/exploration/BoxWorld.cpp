// SPDX-License-Identifier: BSD-3-Clause
#include "BoxWorld.h"

#include <algorithm>
#include <limits>

#include "TableScene.h"
#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap::testing {

std::optional<double> BoxWorld::cast(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction) const {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Thing& thing : things) {
    const Eigen::Array3d a = (thing.box.min() - origin).array() / direction.array();
    const Eigen::Array3d b = (thing.box.max() - origin).array() / direction.array();
    const double in = a.min(b).maxCoeff();
    const double out = a.max(b).minCoeff();
    if (in > 0.0 && in <= out) nearest = std::min(nearest, in);
  }
  if (nearest == std::numeric_limits<double>::infinity()) return std::nullopt;
  return nearest;
}

std::size_t BoxWorld::nearest(const Eigen::Vector3d& point) const {
  const auto distance = [&point](const Thing& thing) { return thing.box.exteriorDistance(point); };
  return static_cast<std::size_t>(
      std::min_element(things.begin(), things.end(),
                       [&](const Thing& a, const Thing& b) { return distance(a) < distance(b); }) -
      things.begin());
}

BoxWorld BoxWorld::room() {
  BoxWorld world;
  world.add(labels::background, box(-3, -3, -0.1, 3, 3, 0));
  world.add(labels::background, box(-3.1, -3, 0, -3, 3, 2));
  world.add(labels::background, box(3, -3, 0, 3.1, 3, 2));
  world.add(labels::background, box(-3, -3.1, 0, 3, -3, 2));
  world.add(labels::background, box(-3, 3, 0, 3, 3.1, 2));
  return world;
}

void BoxWorld::addTable(double x, double y) {
  add(labels::table, box(x - 0.4, y - 0.25, 0.66, x + 0.4, y + 0.25, 0.7));
  // A little above the face: the boxes' own faces are nearest to their points.
  add(labels::object, box(x - 0.3, y - 0.05, 0.7001, x - 0.2, y + 0.05, 0.9));
  add(labels::object, box(x + 0.1, y - 0.1, 0.7001, x + 0.25, y + 0.1, 0.82));
}

HierarchyMapper truthfulMapper(const BoxWorld& world) {
  const auto segment = [&world](const Measurement& z) {
    std::vector<Segment> segments(world.things.size());
    for (std::size_t i = 0; i < segments.size(); ++i) {
      const Label& label = world.things[i].label;
      segments[i].structure = label == labels::table    ? Structure::plane
                              : label == labels::object ? Structure::cluster
                                                        : Structure::remainder;
    }
    for (std::uint32_t i = 0; i < z.world_points.size(); ++i) {
      segments[world.nearest(z.world_points[i].cast<double>())].points.push_back(i);
    }
    std::erase_if(segments, [](const Segment& s) { return s.points.empty(); });
    return segments;
  };
  MappingStrategies strategies;
  strategies.segmentation = makeSegmentation(segment);
  strategies.labeling = makeLabeling([](const Measurement&, const Segment& s) {
    return s.structure == Structure::plane     ? labels::table
           : s.structure == Structure::cluster ? labels::object
                                               : labels::background;
  });
  strategies.association = makeAssociation(
      [](const MapHierarchy& map, const LabelledSegment& s, const Admissible&) -> std::optional<NodeId> {
        if (s.label == labels::background) return kRootId;
        for (const NodeId id : map.ids()) {
          if (map.node(id).label() == s.label && intersects(map.box(id), s.box)) return id;
        }
        return std::nullopt;
      });
  strategies.relations.add(makeRelation("supports", [](const NodeView& above, const NodeView& below) {
    return above.label == labels::table && below.label == labels::object &&
           intersects(above.box, below.box.padded(0.02));
  }));
  strategies.update = makeBlockScanUpdate();
  LabelProfiles profiles;
  profiles[labels::background].resolution = 0.05;
  profiles[labels::background].carve = Carve::scan;
  profiles[labels::table].resolution = 0.02;
  profiles[labels::object].resolution = 0.01;
  return HierarchyMapper({}, profiles, std::move(strategies));
}

BoxRobot::BoxRobot(const BoxWorld& world, const Eigen::Vector2d& start)
    : world_(world), at_{Pose(start.x(), start.y(), 0, 0, 0, 0), Pose(0, 0, 1.2, 0, 0, 0)} {
  model_.camera = {240, 180, 202.0, 202.0, 119.5, 89.5};
}

bool BoxRobot::moveTo(const Viewpoint& goal, std::span<const Eigen::Vector2d> path) {
  ++drives;
  if (path.size() > 1 && refuses && refuses(path.back())) return false;
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!stops || !stops(path[i])) continue;
    at_.world_T_base = Pose(path[i - 1].x(), path[i - 1].y(), 0.0, at_.world_T_base.yaw(), 0.0, 0.0);
    return false;
  }
  at_ = goal;
  return true;
}

std::optional<SourceItem> BoxRobot::next() {
  if (blind) return std::nullopt;
  const Pose world_T_sensor = at_.world_T_sensor();
  const Eigen::Isometry3d sensor = toIsometry(world_T_sensor);
  DepthImage image{model_.camera, {}};
  for (int v = 0; v < model_.camera.height; ++v) {
    for (int u = 0; u < model_.camera.width; ++u) {
      const auto depth =
          world_.cast(sensor.translation(), sensor.rotation() * model_.camera.point(u, v, 1.0));
      image.depth.push_back(depth && *depth < 5.0 ? static_cast<float>(*depth) : 0.0F);
    }
  }
  Measurement z = unproject(std::move(image), world_T_sensor, {});
  z.scan = scans_;
  z.stamp = static_cast<double>(scans_++);
  z.sensor = "camera";
  return z;
}

}  // namespace hoctomap::testing
