// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <numeric>

#include "BoxScene.h"
#include "hoctomap/tabletop/LabelImage.h"
#include "hoctomap/tabletop/TabletopSegmentation.h"

namespace hoctomap {
namespace {

using test::BoxScene;
using test::ofKind;
using test::pointsIn;
using test::Rng;
using test::uniform;

const Eigen::Vector3d kEye(0.0, 0.0, 1.4);
const Eigen::Vector3d kTarget(0.9, 0.0, 0.75);

/// What holds whatever tells objects apart.
class TabletopSegmentationTest : public testing::TestWithParam<SegmentationMethod> {
 protected:
  [[nodiscard]] static std::vector<Segment> segment(const Measurement& z, std::uint64_t seed = 1) {
    TabletopSegmentationConfig config;
    config.method = GetParam();
    config.seed = seed;
    return TabletopSegmentation(config).segment(z);
  }
};

INSTANTIATE_TEST_SUITE_P(Methods, TabletopSegmentationTest,
                         testing::Values(SegmentationMethod::euclidean, SegmentationMethod::convex_patches),
                         [](const auto& of) {
                           return std::string(of.param == SegmentationMethod::euclidean ? "Euclidean"
                                                                                        : "ConvexPatches");
                         });

/// A floor, a wall, a table whose top is at 0.75 m, and objects on it that keep a distance from each other.
struct RandomTable {
  BoxScene scene;
  std::vector<std::size_t> objects;

  explicit RandomTable(Rng& rng) {
    scene.add(0.0, 0.0, -0.1, 8.0, 8.0, 0.1);
    scene.add(2.5, 0.0, 0.0, 0.1, 8.0, 2.5);
    scene.add(0.95, 0.0, 0.72, 0.8, 1.4, 0.03);
    for (int i = 0; i < 4; ++i) {
      const double x = uniform(rng, 0.75, 1.15);
      const double y = -0.42 + 0.28 * i + uniform(rng, -0.03, 0.03);
      objects.push_back(
          scene.add(x, y, 0.75, uniform(rng, 0.04, 0.12), uniform(rng, 0.04, 0.12), uniform(rng, 0.05, 0.2)));
    }
  }
};

void expectPartition(const Measurement& z, const std::vector<Segment>& segments) {
  PointIndices all;
  for (const auto& s : segments) {
    EXPECT_FALSE(s.points.empty());
    EXPECT_TRUE(std::is_sorted(s.points.begin(), s.points.end()));
    EXPECT_EQ(s.plane.has_value(), s.structure == Structure::plane);
    all.insert(all.end(), s.points.begin(), s.points.end());
  }
  std::sort(all.begin(), all.end());
  PointIndices expected(z.world_points.size());
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(all, expected);  // disjoint, and their union is z (Eq. 5)
  EXPECT_TRUE(std::is_sorted(segments.begin(), segments.end(),
                             [](const auto& a, const auto& b) { return a.structure < b.structure; }));
}

TEST_P(TabletopSegmentationTest, FindsEveryObjectOfRandomScenes) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    Rng rng(seed);
    const RandomTable table(rng);
    const auto z = table.scene.look(kEye, kTarget, &rng);
    const auto segments = segment(z);
    expectPartition(z, segments);
    EXPECT_EQ(ofKind(segments, Structure::plane).size(), 1U) << "seed " << seed;
    const auto objects = ofKind(segments, Structure::cluster);
    ASSERT_EQ(objects.size(), table.objects.size()) << "seed " << seed;
    for (std::size_t i = 1; i < objects.size(); ++i) {
      EXPECT_GE(objects[i - 1].points.size(), objects[i].points.size());
    }
    for (const auto index : table.objects) {  // each is in one segment, and that segment in it
      const auto& box = table.scene.boxes[index];
      const auto held = std::count_if(objects.begin(), objects.end(), [&](const Segment& s) {
        return pointsIn(z, s, box) == s.points.size();
      });
      EXPECT_EQ(held, 1) << "seed " << seed << " object " << index;
    }
  }
}

TEST_P(TabletopSegmentationTest, GivesTheTablesPlane) {
  Rng rng(3);
  const RandomTable table(rng);
  const auto z = table.scene.look(kEye, kTarget, &rng);
  const auto planes = ofKind(segment(z), Structure::plane);
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_GT(planes[0].plane->normal().z(), 0.9998);  // towards the sensor
  EXPECT_NEAR(planes[0].plane->signedDistance(Eigen::Vector3d(0.95, 0.0, 0.75)), 0.0, 0.002);
  EXPECT_GT(planes[0].plane->signedDistance(z.origin()), 0.0);
}

TEST_P(TabletopSegmentationTest, DependsOnNothingButScanAndSeed) {
  Rng rng(5);
  const RandomTable table(rng);
  const auto z = table.scene.look(kEye, kTarget, &rng);
  const auto once = segment(z, 4);
  const auto again = segment(z, 4);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) EXPECT_EQ(once[i].points, again[i].points);
  EXPECT_EQ(segment(z, 11).size(), once.size());  // another seed finds the same things
}

TEST_P(TabletopSegmentationTest, UnorganisedCloudsGiveNearlyTheSame) {
  Rng rng(6);
  const RandomTable table(rng);
  auto z = table.scene.look(kEye, kTarget, &rng);
  const auto organised = segment(z);
  z.image.reset();
  z.pixel_of_point.clear();
  const auto unorganised = segment(z);
  ASSERT_EQ(unorganised.size(), organised.size());
  for (std::size_t i = 0; i < organised.size(); ++i) {
    EXPECT_EQ(unorganised[i].structure, organised[i].structure);
    EXPECT_NEAR(static_cast<double>(unorganised[i].points.size()),
                static_cast<double>(organised[i].points.size()),
                0.1 * static_cast<double>(organised[i].points.size()) + 20.0);
  }
}

TEST_P(TabletopSegmentationTest, TakesEmptyAndTinyClouds) {
  EXPECT_TRUE(segment(Measurement{}).empty());
  Measurement z;
  for (int n = 1; n < 6; ++n) {
    z.world_points.emplace_back(0.1F * static_cast<float>(n), 0.05F * static_cast<float>(n * n), 0.75F);
    const auto segments = segment(z);
    ASSERT_EQ(segments.size(), 1U);
    EXPECT_EQ(segments[0].structure, Structure::remainder);
    expectPartition(z, segments);
  }
}

TEST_P(TabletopSegmentationTest, TakesAnyHeapOfPoints) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Rng rng(seed);
    Measurement z;
    z.world_T_sensor = Pose(0, 0, 1.5, 0, 0, 0);
    for (int i = 0; i < 4000; ++i)
      z.world_points.push_back(test::uniformVector(rng, -2.0, 2.0).cast<float>());
    z.world_points.emplace_back(9e5F, -9e5F, 0.7F);  // far, but a point
    const auto segments = segment(z);
    expectPartition(z, segments);
    EXPECT_TRUE(ofKind(segments, Structure::plane).empty());  // noise makes no table
  }
}

TEST_P(TabletopSegmentationTest, MugOnPaperIsAMug) {
  BoxScene scene;
  scene.add(0.95, 0.0, 0.72, 0.8, 1.4, 0.03);
  scene.add(0.95, 0.0, 0.75, 0.3, 0.4, 0.012);  // papers: too high for table noise, too low for a cluster
  const auto on_paper = scene.add(0.9, 0.05, 0.762, 0.08, 0.08, 0.1);
  const auto beside = scene.add(0.9, -0.235, 0.75, 0.06, 0.06, 0.1);  // half a centimetre from the papers
  Rng rng(1);
  const auto z = scene.look(kEye, kTarget, &rng);
  const auto objects = ofKind(segment(z), Structure::cluster);
  // The paper's clusters leave papers to the table; the patches find them, too.
  const bool papers = GetParam() == SegmentationMethod::convex_patches;
  ASSERT_EQ(objects.size(), papers ? 3U : 2U);
  for (const auto thing : {on_paper, beside}) {
    const auto held = std::count_if(objects.begin(), objects.end(), [&](const Segment& o) {
      return pointsIn(z, o, scene.boxes[thing]) == o.points.size();
    });
    EXPECT_EQ(held, 1) << thing;
  }
}

TEST_P(TabletopSegmentationTest, TheFootOfAMugOnPaperIsTheMugs) {
  BoxScene scene;
  scene.add(0.95, 0.0, 0.72, 0.8, 1.4, 0.03);
  scene.add(0.95, 0.0, 0.75, 0.3, 0.4, 0.012);
  const Eigen::AlignedBox3d mug = scene.boxes[scene.add(0.9, 0.05, 0.762, 0.08, 0.08, 0.1)];
  Rng rng(1);
  const auto z = scene.look(kEye, kTarget, &rng);
  Eigen::AlignedBox3d foot = mug;  // the part of it that is no higher than what may be thin
  foot.min() += Eigen::Vector3d(-0.01, -0.01, 0.008);
  foot.max() += Eigen::Vector3d(0.01, 0.01, -0.075);
  std::size_t of_mug = 0;
  std::size_t of_others = 0;
  for (const auto& o : ofKind(segment(z), Structure::cluster)) {
    const bool is_mug = pointsIn(z, o, mug) == o.points.size();
    for (const auto i : o.points) {
      if (foot.contains(z.world_points[i].cast<double>())) ++(is_mug ? of_mug : of_others);
    }
  }
  EXPECT_GT(of_mug, 50U);
  EXPECT_LT(10 * of_others, of_mug);
}

TEST_P(TabletopSegmentationTest, ObjectCutByTheImageIsAnObject) {
  BoxScene scene;
  scene.add(0.95, 0.0, 0.72, 0.8, 3.0, 0.03);
  const auto cut = scene.add(0.9, 0.6, 0.75, 0.1, 0.12, 0.15);
  Rng rng(1);
  const auto z = scene.look(kEye, kTarget, &rng);
  const auto objects = ofKind(segment(z), Structure::cluster);
  ASSERT_EQ(objects.size(), 1U);
  EXPECT_EQ(pointsIn(z, objects[0], scene.boxes[cut]), objects[0].points.size());
  const auto touches_border = std::any_of(objects[0].points.begin(), objects[0].points.end(),
                                          [&](auto i) { return z.pixel_of_point[i] % 320 < 2; });
  EXPECT_TRUE(touches_border);  // or the scene does not show what it should
}

TEST_P(TabletopSegmentationTest, ObjectHiddenByAnotherStands) {
  BoxScene scene;
  scene.add(0.95, 0.0, 0.72, 0.8, 1.4, 0.03);
  scene.add(0.75, 0.0, 0.75, 0.1, 0.3, 0.15);
  const auto rear = scene.add(1.05, 0.0, 0.75, 0.1, 0.1, 0.25);  // its foot is out of sight
  Rng rng(1);
  const auto z = scene.look(kEye, kTarget, &rng);
  const auto objects = ofKind(segment(z), Structure::cluster);
  ASSERT_EQ(objects.size(), 2U);
  EXPECT_GT(pointsIn(z, objects[1], scene.boxes[rear]), 100U);
}

TEST(LabelImage, FollowsTheContract) {
  Measurement z;
  z.image = DepthImage{{3, 2, 1.0, 1.0, 0.0, 0.0}, {0, 1, 1, 1, 1, 0}};
  z.world_points.resize(4);
  z.pixel_of_point = {1, 2, 3, 4};
  const Eigen::Hyperplane<double, 3> plane(Eigen::Vector3d::UnitZ(), 0.0);
  const std::vector<Segment> segments{{Structure::remainder, {0}, {}},
                                      {Structure::plane, {1}, plane},
                                      {Structure::cluster, {2}, {}},
                                      {Structure::cluster, {3}, {}}};
  EXPECT_EQ(labelImage(z, segments), (std::vector<std::uint16_t>{0, 1, 10, 100, 101, 0}));
  EXPECT_EQ(labelPoints(z, segments), (std::vector<std::uint16_t>{1, 10, 100, 101}));
  z.image.reset();
  EXPECT_TRUE(labelImage(z, segments).empty());
}

}  // namespace
}  // namespace hoctomap
