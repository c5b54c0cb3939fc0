// SPDX-License-Identifier: BSD-3-Clause
#include "SmallScenes.h"

namespace hoctomap::test {

Solid makeSolid(const std::string& name, SolidLabel label, const Shape& shape, const Pose& support_T_solid,
                std::optional<SolidId> support) {
  Solid solid;
  solid.name = name;
  solid.label = label;
  solid.surface = std::make_shared<const TriangleMesh>(tessellate(shape));
  solid.top = surfaceExtent(*solid.surface, Eigen::Isometry3d::Identity()).box.max().z();
  solid.support = support;
  solid.support_T_solid = support_T_solid;
  return solid;
}

TableScene tableScene() {
  TableScene t;
  t.floor = t.scene.add(makeSolid("floor", SolidLabel::background, BoxShape{{6, 6, 0.1}}, at(0, 0, -0.1)));
  t.table = t.scene.add(
      makeSolid("table", SolidLabel::table, TableShape{{0.8, 1.0}, 0.7, 0.03, 0.05}, at(1, 0, 0)));
  t.box = t.scene.add(
      makeSolid("box", SolidLabel::object, BoxShape{{0.1, 0.15, 0.2}}, at(0.1, -0.2, 0, 0.3), t.table));
  t.sphere =
      t.scene.add(makeSolid("sphere", SolidLabel::object, SphereShape{0.06}, at(-0.1, 0.2, 0), t.table));
  return t;
}

RangeSensorModel idealCamera() {
  RangeSensorModel model;
  model.camera = {80, 60, 70.0, 72.0, 39.5, 29.5};
  model.min_range = 0.2;
  model.max_range = 8.0;
  return ideal(model);
}

Simulation tableSimulation() {
  Simulation simulation;
  simulation.scene = tableScene().scene;
  simulation.sensor = idealCamera();
  for (const double y : {-0.5, 0.0, 0.5})
    simulation.views.push_back(lookAt({-0.2, y, 1.3}, {1.0, 0.0, 0.75}));
  return simulation;
}

}  // namespace hoctomap::test
