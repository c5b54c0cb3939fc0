// SPDX-License-Identifier: BSD-3-Clause
#include "Strays.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "BoxScene.h"

namespace hoctomap {
namespace {

using test::Rng;

/// A table seen from above, one object on it, and points added one by one that nobody took.
class Strays : public testing::Test {
 protected:
  Strays() {
    test::BoxScene scene;
    scene.add(1.0, 0.0, 0.72, 0.8, 1.2, 0.03);
    const auto object = scene.add(1.0, 0.0, 0.75, 0.1, 0.1, 0.1);
    Rng rng(1);
    z_ = scene.look({0.0, 0.0, 1.5}, {1.0, 0.0, 0.75}, &rng);
    tables_ = findTables(z_, config_);
    const Eigen::AlignedBox3d grown(scene.boxes[object].min() - Eigen::Vector3d(0.01, 0.01, -0.03),
                                    scene.boxes[object].max() + Eigen::Vector3d::Constant(0.01));
    auto& points = objects_.emplace_back();
    for (std::uint32_t i = 0; i < z_.world_points.size(); ++i) {
      if (grown.contains(z_.world_points[i].cast<double>())) points.push_back(i);
    }
  }

  std::uint32_t add(double x, double y, double z) {
    z_.world_points.emplace_back(Eigen::Vector3d(x, y, z).cast<float>());
    return static_cast<std::uint32_t>(z_.world_points.size() - 1);
  }
  void attach() { attachStrays(z_, tables_, objects_, config_); }
  static bool has(const PointIndices& points, std::uint32_t i) {
    EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
    return std::binary_search(points.begin(), points.end(), i);
  }

  TabletopSegmentationConfig config_;
  Measurement z_;
  std::vector<TableSurface> tables_;
  std::vector<PointIndices> objects_;
};

TEST_F(Strays, BelongToTheObjectTheyTouch) {
  ASSERT_EQ(tables_.size(), 1U);
  ASSERT_GT(objects_[0].size(), 100U);
  const auto rim = add(1.0, 0.0, 0.857);
  const auto beyond = add(1.0, 0.0, 0.85 + config_.cluster_tolerance + 0.02);
  attach();
  EXPECT_TRUE(has(objects_[0], rim));
  EXPECT_FALSE(has(objects_[0], beyond));
}

TEST_F(Strays, OnTheSurfaceBelongToTheTable) {
  ASSERT_EQ(tables_.size(), 1U);
  const auto on_surface = add(1.0, 0.3, 0.752);
  const auto beside_table = add(1.0, 0.9, 0.752);
  attach();
  EXPECT_TRUE(has(tables_[0].points, on_surface));
  EXPECT_FALSE(has(tables_[0].points, beside_table));
}

TEST_F(Strays, AreNeverTakenTwice) {
  attach();
  const auto table = tables_[0].points;
  const auto object = objects_[0];
  attach();
  EXPECT_EQ(tables_[0].points, table);
  EXPECT_EQ(objects_[0], object);
  PointIndices both;
  std::set_intersection(table.begin(), table.end(), object.begin(), object.end(), std::back_inserter(both));
  EXPECT_TRUE(both.empty());
}

TEST_F(Strays, WithoutTablesThereAreNone) {
  tables_.clear();
  const auto before = objects_;
  attach();
  EXPECT_EQ(objects_, before);
}

}  // namespace
}  // namespace hoctomap
