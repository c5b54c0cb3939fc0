// SPDX-License-Identifier: BSD-3-Clause
// Objects told apart by their surfaces, on simulated scans of a camera with noise and shadows at edges.
#include <gtest/gtest.h>

#include <map>

#include "BoxScene.h"
#include "hoctomap/simulation/Shape.h"
#include "hoctomap/simulation/SimulatedRangeSensor.h"
#include "hoctomap/simulation/ViewPath.h"
#include "hoctomap/tabletop/TabletopSegmentation.h"

namespace hoctomap {
namespace {

using test::ofKind;

/// A floor and a table whose top is at 0.75 m, objects on it, and what a camera sees of them.
class Desk {
 public:
  Desk() {
    add("floor", SolidLabel::background, BoxShape{{6.0, 6.0, 0.1}}, Pose(0, 0, -0.1, 0, 0, 0), {});
    table_ = add("table", SolidLabel::table, TableShape{{0.9, 1.4}, 0.75, 0.03, 0.05},
                 Pose(0.95, 0, 0, 0, 0, 0), {});
  }

  /// Puts a shape on the table, or on another solid; x, y from the support's centre.
  SolidId put(const Shape& shape, double x, double y, double yaw = 0.0, std::optional<SolidId> on = {}) {
    objects_.push_back(add("object" + std::to_string(objects_.size()), SolidLabel::object, shape,
                           Pose(x, y, 0, yaw, 0, 0), on ? *on : table_));
    return objects_.back();
  }

  struct Scan {
    Measurement z;
    std::vector<std::int32_t> solid_of_point;
  };

  /// From the front of the table, or from `back` metres farther away.
  [[nodiscard]] Scan look(double back = 0.0) const {
    RangeSensorModel model;
    model.camera = {640, 480, 525.0, 525.0, 319.5, 239.5};
    const View view = lookAt({0.1 - back, 0.15, 1.45 + back / 4.0}, {0.9, 0.0, 0.75});
    const Pose world_T_sensor = view.world_T_sensor();
    auto reading = SimulatedRangeSensor(model, 1, 1).sense(scene_, world_T_sensor, 0);
    Scan scan{unproject(std::move(reading.sensed.image), world_T_sensor, RangeLimits{}), {}};
    for (const auto pixel : scan.z.pixel_of_point) {
      scan.solid_of_point.push_back(reading.sensed.solids[pixel]);
    }
    return scan;
  }

  [[nodiscard]] const std::vector<SolidId>& objects() const { return objects_; }

 private:
  SolidId add(const std::string& name, SolidLabel label, const Shape& shape, const Pose& pose,
              std::optional<SolidId> support) {
    Solid solid;
    solid.name = name;
    solid.label = label;
    solid.surface = std::make_shared<const TriangleMesh>(tessellate(shape));
    solid.top = surfaceExtent(*solid.surface, Eigen::Isometry3d::Identity()).box.max().z();
    solid.support = support;
    solid.support_T_solid = pose;
    return scene_.add(std::move(solid));
  }

  Scene scene_;
  SolidId table_;
  std::vector<SolidId> objects_;
};

std::vector<Segment> segment(const Measurement& z, const TabletopSegmentationConfig& config = {}) {
  return TabletopSegmentation(config).segment(z);
}

/// Largest F of any cluster with the points of a solid.
double bestOverlap(const Desk::Scan& scan, const std::vector<Segment>& clusters, SolidId solid) {
  const auto id = static_cast<std::int32_t>(solid.value);
  const auto all = std::count(scan.solid_of_point.begin(), scan.solid_of_point.end(), id);
  double best = 0.0;
  for (const auto& s : clusters) {
    const auto shared =
        std::count_if(s.points.begin(), s.points.end(), [&](auto i) { return scan.solid_of_point[i] == id; });
    best = std::max(best, 2.0 * static_cast<double>(shared) /
                              (static_cast<double>(all) + static_cast<double>(s.points.size())));
  }
  return best;
}

/// One segment an object, and no other.
void expectEachIsOne(const Desk& desk, const Desk::Scan& scan, double least = 0.9,
                     const TabletopSegmentationConfig& config = {}) {
  const auto clusters = ofKind(segment(scan.z, config), Structure::cluster);
  EXPECT_EQ(clusters.size(), desk.objects().size());
  for (const auto object : desk.objects()) {
    EXPECT_GT(bestOverlap(scan, clusters, object), least) << "solid " << object.value;
  }
}

TEST(ConvexPatches, TouchingBoxesAreTwo) {
  Desk desk;
  desk.put(BoxShape{{0.10, 0.14, 0.12}}, 0.0, -0.371);
  desk.put(BoxShape{{0.16, 0.14, 0.07}}, 0.0, -0.229);
  expectEachIsOne(desk, desk.look(), 0.85);  // the wall between them is seen at 70 degrees
}

TEST(ConvexPatches, ABoxBeforeAnotherIsTwo) {
  Desk desk;
  desk.put(BoxShape{{0.10, 0.20, 0.16}}, 0.1, 0.0, 0.3);
  desk.put(BoxShape{{0.08, 0.10, 0.08}}, -0.05, 0.02, -0.2);
  expectEachIsOne(desk, desk.look());
}

TEST(ConvexPatches, StackedBoxesAreAsManyAsThereAre) {
  Desk desk;
  const auto low = desk.put(BoxShape{{0.24, 0.30, 0.08}}, 0.0, 0.0);
  const auto middle = desk.put(BoxShape{{0.14, 0.18, 0.07}}, 0.0, 0.02, 0.4, low);
  desk.put(CylinderShape{0.035, 0.10}, 0.0, 0.0, 0.0, middle);
  expectEachIsOne(desk, desk.look());
}

// Fronts in one plane: between the two there is a crease above the lower one, and nothing below its top.
TEST(ConvexPatches, BoxesWithFlushFrontsAreTwo) {
  Desk desk;
  desk.put(BoxShape{{0.10, 0.12, 0.17}}, 0.0, -0.06);
  desk.put(BoxShape{{0.16, 0.12, 0.09}}, 0.03, 0.06);
  expectEachIsOne(desk, desk.look(), 0.85);
}

TEST(ConvexPatches, ABoxFlushWithTheFrontOfTheOneBelowIsTwo) {
  Desk desk;
  const auto low = desk.put(BoxShape{{0.18, 0.24, 0.12}}, 0.0, 0.0);
  desk.put(BoxShape{{0.10, 0.10, 0.08}}, -0.04, 0.07, 0.0, low);
  expectEachIsOne(desk, desk.look(), 0.85);
}

TEST(ConvexPatches, BowlsAndCupsAreWhole) {
  Desk desk;
  desk.put(TurnedShape{{{0.04, 0.0}, {0.065, 0.02}, {0.08, 0.05}, {0.085, 0.07}}, 0.004, {}}, 0.0, 0.25);
  desk.put(TurnedShape{{{0.04, 0.0}, {0.04, 0.09}}, 0.004, Handle{0.02, 0.075, 0.03, 0.006}}, 0.0, -0.05);
  desk.put(SphereShape{0.05}, 0.0, -0.3);
  expectEachIsOne(desk, desk.look(), 0.85);
}

TEST(ConvexPatches, ABottleIsWhole) {
  Desk desk;
  desk.put(TurnedShape{{{0.04, 0.0}, {0.04, 0.14}, {0.015, 0.19}, {0.015, 0.24}}, 0.0, {}}, 0.0, 0.0);
  expectEachIsOne(desk, desk.look());
}

TEST(ConvexPatches, TheSameScanGivesTheSamePoints) {
  Desk desk;
  desk.put(BoxShape{{0.10, 0.14, 0.12}}, 0.0, -0.071);
  desk.put(CylinderShape{0.04, 0.12}, 0.0, 0.05);
  const auto scan = desk.look();
  const auto once = segment(scan.z);
  const auto again = segment(scan.z);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].points, again[i].points);
}

TEST(ConvexPatches, CloudsWithoutAnImageGiveNearlyTheSame) {
  Desk desk;
  const auto low = desk.put(BoxShape{{0.2, 0.24, 0.08}}, 0.0, 0.15);
  desk.put(CylinderShape{0.05, 0.10}, 0.0, 0.0, 0.0, low);
  desk.put(BoxShape{{0.10, 0.12, 0.12}}, 0.0, -0.2);
  desk.put(BoxShape{{0.16, 0.10, 0.07}}, 0.0, -0.312);
  auto scan = desk.look();
  expectEachIsOne(desk, scan);
  scan.z.image.reset();
  scan.z.pixel_of_point.clear();
  expectEachIsOne(desk, scan, 0.85);
}

TEST(ConvexPatches, FarObjectsAreObjects) {
  Desk desk;
  desk.put(BoxShape{{0.15, 0.15, 0.15}}, 0.0, -0.2);
  desk.put(CylinderShape{0.06, 0.2}, 0.0, 0.25);
  expectEachIsOne(desk, desk.look(0.9), 0.85);
}

}  // namespace
}  // namespace hoctomap
