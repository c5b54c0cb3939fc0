// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>

#include <cstdlib>

#include "hoctomap/tabletop/TabletopSegmentation.h"
#include "segmentation/LabelledScenes.h"
#include "segmentation/SimulatedScenes.h"
#include "support/SharedData.h"

namespace hoctomap {
namespace {

GreyImage image(std::vector<std::uint16_t> values) {
  return {static_cast<int>(values.size()), 1, std::move(values)};
}

TEST(SegmentationScore, PartsNearEachOtherAreOneObject) {
  std::vector<std::uint16_t> row(40, 1);
  row[2] = 20;
  row[10] = 21;  // 8 pixels on
  row[20] = 20;  // 10 pixels on
  row[30] = 31;
  row[39] = 0;
  const auto joined = joinedTruth(image(row));
  EXPECT_EQ(joined.values[2], joined.values[10]);
  EXPECT_NE(joined.values[10], joined.values[20]);
  EXPECT_NE(joined.values[20], joined.values[30]);
  EXPECT_GE(joined.values[2], 2);
  EXPECT_EQ(joined.values[0], 1);
  EXPECT_EQ(joined.values[39], 0);
}

TEST(SegmentationScore, MatchesOneToOneSoThatTheSumIsLargest) {
  // Object 100 overlaps both true ones, 101 only the first.
  const auto truth = image({2, 2, 2, 2, 3, 3, 1, 0});
  const auto score = scoreSegmentation(image({100, 100, 101, 101, 100, 100, 10, 102}), truth);
  EXPECT_DOUBLE_EQ(score.found, 2.0);  // where there is no true return, nothing counts
  EXPECT_DOUBLE_EQ(score.objects, 2.0);
  EXPECT_DOUBLE_EQ(score.precision, 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(score.recall, 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(score.f, 4.0 / 6.0);
  EXPECT_DOUBLE_EQ(score.share75, 0.0);
  const auto exact = scoreSegmentation(image({100, 100, 100, 100, 107, 107, 1, 0}), truth);
  EXPECT_DOUBLE_EQ(exact.f, 1.0);
  EXPECT_DOUBLE_EQ(exact.share75, 1.0);
  EXPECT_DOUBLE_EQ(scoreSegmentation(image({1, 1, 1, 1, 1, 1, 1, 1}), truth).f, 0.0);
}

TEST(SegmentationScore, LabelledScenesAreTakenApartAsPeopleDo) {
  const auto data = test::sharedData();
  if (!data) GTEST_SKIP() << "no shared data";
  setenv("HOCTOMAP_MRPT", HOCTOMAP_HELPER, 1);
  const TabletopSegmentation segmentation{TabletopSegmentationConfig{}};
  const auto scenes = labelledScenes(*data / "mosd");
  SegmentationScore sum;
  double count = 0.0;
  for (std::size_t i = 0; i < scenes.size(); i += 5) {
    sum += segmentScene(scenes[i], segmentation, [](const GreyImage&) {}).score;
    count += 1.0;
  }
  EXPECT_GT(sum.f / count, 0.96);
  EXPECT_GT(sum.share75 / count, 0.96);
}

/// Mean over the first scenes of a kind, with the default configuration.
SegmentationScore meanScore(SceneKind kind, int scenes) {
  const TabletopSegmentation segmentation({});
  SegmentationScore sum;
  for (int seed = 1; seed <= scenes; ++seed) {
    const auto view = look(makeSegmentationScene(kind, static_cast<std::uint64_t>(seed)));
    sum += segmentView({}, view, segmentation, [](const GreyImage&) {}).score;
  }
  for (double* value : {&sum.f, &sum.share75, &sum.found, &sum.objects}) *value /= scenes;
  return sum;
}

TEST(SimulatedScenes, ABentTableHasNoObjects) {
  EXPECT_EQ(meanScore(SceneKind::bare, 6).found, 0.0);
}

TEST(SimulatedScenes, ThinThingsAreFoundOnABentTable) {
  const auto score = meanScore(SceneKind::thin, 6);
  EXPECT_GT(score.objects, 5.0);
  EXPECT_GT(score.f, 0.93);
  EXPECT_GT(score.share75, 0.90);
  EXPECT_LT(score.found, score.objects + 0.5);
}

TEST(SimulatedScenes, OfTheSameSeedAreTheSame) {
  const auto a = look(makeSegmentationScene(SceneKind::piled, 3));
  const auto b = look(makeSegmentationScene(SceneKind::piled, 3));
  EXPECT_EQ(a.z.image->depth, b.z.image->depth);
  EXPECT_EQ(a.truth.values, b.truth.values);
  EXPECT_GE(*std::max_element(a.truth.values.begin(), a.truth.values.end()), 20 + 10 * 7) << "8 things";
}

}  // namespace
}  // namespace hoctomap
