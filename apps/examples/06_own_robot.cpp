// SPDX-License-Identifier: BSD-3-Clause
// An own robot explores: it and its camera implement two small interfaces. What stands here for its drivers
// is a world of boxes; a real robot would send goals to its navigation and wait for frames of its camera.
#include <hoctomap/exploration/Explorer.h>
#include <hoctomap/octree/BlockScanUpdate.h>
#include <hoctomap/tabletop/Tabletop.h>
#include <hoctomap/tabletop/TabletopSegmentation.h>

#include <algorithm>
#include <iostream>

using namespace hoctomap;
using Eigen::Vector3d;

namespace {
/// A room of 5 m, which the robot sees from within, a table in it, and a parcel on the table.
const std::vector<Eigen::AlignedBox3d> kWorld{{Vector3d(-2.5, -2.5, 0.0), Vector3d(2.5, 2.5, 6.0)},
                                              {Vector3d(-0.5, -0.4, 0.68), Vector3d(0.5, 0.4, 0.72)},
                                              {Vector3d(-0.1, -0.07, 0.72), Vector3d(0.1, 0.07, 0.86)}};

class MyRobot final : public Robot, public MeasurementSource {
 public:
  [[nodiscard]] const RobotModel& model() const override { return model_; }
  [[nodiscard]] Pose world_T_base() const override { return at_.world_T_base; }
  /// Returns false where navigation gives up; `world_T_base` then says where.
  bool moveTo(const Viewpoint& goal, std::span<const Eigen::Vector2d>) override {
    at_ = goal;
    return true;
  }
  /// One frame from where the robot is.
  [[nodiscard]] std::optional<SourceItem> next() override {
    const auto world_T_camera = toIsometry(at_.world_T_sensor());
    DepthImage image{model_.camera, {}};
    for (int v = 0; v < image.camera.height; ++v)
      for (int u = 0; u < image.camera.width; ++u)
        image.depth.push_back(depth(world_T_camera, image.camera.point(u, v, 1.0)));
    Measurement z = unproject(std::move(image), at_.world_T_sensor(), {});
    z.stamp = static_cast<double>(z.scan = scans_++);
    return z;
  }

 private:
  static float depth(const Eigen::Isometry3d& world_T_camera, const Vector3d& beam) {
    const Vector3d origin = world_T_camera.translation(), direction = world_T_camera.rotation() * beam;
    double nearest = 5.0;
    for (const auto& box : kWorld) {
      const Eigen::Array3d a = (box.min() - origin).array() / direction.array();
      const Eigen::Array3d b = (box.max() - origin).array() / direction.array();
      const double in = a.min(b).maxCoeff(), out = a.max(b).minCoeff();
      if (out > 0.0 && in <= out) nearest = std::min(nearest, in > 0.0 ? in : out);
    }
    return nearest < 5.0 ? static_cast<float>(nearest) : 0.0F;  // 0: no return
  }

  RobotModel model_{.camera = {320, 240, 270.0, 270.0, 159.5, 119.5}};
  Viewpoint at_{Pose(-1.8, -1.5, 0.0, 0.5, 0.0, 0.0), Pose(0.0, 0.0, 1.2, 0.0, 0.4, 0.0)};
  std::uint64_t scans_ = 0;
};
}  // namespace

int main() {
  MappingStrategies strategies;
  strategies.segmentation = std::make_unique<TabletopSegmentation>(TabletopSegmentationConfig{});
  strategies.labeling = makeTabletopLabeling();
  strategies.relations = makeTabletopRelations();
  strategies.association = makeTabletopAssociation(0.0);
  strategies.update = makeBlockScanUpdate();
  LabelProfiles profiles;
  profiles[labels::background].resolution = 0.05;
  profiles[labels::background].carve = Carve::scan;  // the free space that the robot may drive in
  profiles[labels::table].resolution = 0.01;
  profiles[labels::object].resolution = 0.005;
  HierarchyMapper mapper({}, profiles, std::move(strategies));
  MyRobot robot;
  Explorer explorer({}, robot, robot, mapper);
  explorer.onStep([](const ExplorationStep& step) { std::cout << toString(step.kind) << "\n"; });
  for (const auto& [table, outcome] : explorer.run().tables)
    std::cout << "table " << table.value << " " << toString(outcome) << "\n";
}
