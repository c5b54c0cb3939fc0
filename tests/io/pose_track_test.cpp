// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <limits>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/io/PoseTrack.h"
#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

double difference(const Pose& a, const Pose& b) {
  return (toIsometry(a).matrix() - toIsometry(b).matrix()).norm();
}

TEST(PoseTrack, IsExactAtItsOwnTimes) {
  test::Rng rng(1);
  PoseTrack track;
  std::vector<Pose> poses;
  for (int i = 0; i < 50; ++i) {
    poses.push_back(test::randomPose(rng, 5.0));
    track.add(i * 0.1, poses.back());
  }
  track.finish();
  for (int i = 0; i < 50; ++i)
    EXPECT_LT(difference(*track.at(i * 0.1, 0.0), poses[static_cast<std::size_t>(i)]), 1e-12);
}

// Closed form: constant velocity along a line and constant turn about a fixed axis.
TEST(PoseTrack, InterpolatesAConstantScrewAlongItsAxisExactly) {
  const auto truth = [](double t) { return Pose(2.0 * t, -t, 0.5 * t, 0.3 * t, 0.0, 0.0); };
  PoseTrack track;
  for (int i = 0; i <= 10; ++i) track.add(i, truth(i));
  track.finish();
  for (double t = 0.0; t <= 10.0; t += 0.037) EXPECT_LT(difference(*track.at(t, 1.0), truth(t)), 1e-12) << t;
}

TEST(PoseTrack, TurnsTheShortWayAcrossPi) {
  PoseTrack track;
  track.add(0.0, Pose(0, 0, 0, 3.0, 0, 0));
  track.add(1.0, Pose(0, 0, 0, -3.0, 0, 0));
  track.finish();
  const double expected = 3.0 + 0.5 * (2.0 * M_PI - 6.0);
  EXPECT_LT(difference(*track.at(0.5, 1.0), Pose(0, 0, 0, expected, 0, 0)), 1e-12);
}

TEST(PoseTrack, NeverExtrapolatesAndNeverBridgesAWideGap) {
  PoseTrack track;
  track.add(1.0, Pose());
  track.add(2.0, Pose());
  track.add(5.0, Pose());
  track.finish();
  EXPECT_FALSE(track.at(0.999, 10.0));
  EXPECT_FALSE(track.at(5.001, 10.0));
  EXPECT_TRUE(track.at(1.5, 1.0));
  EXPECT_FALSE(track.at(3.0, 1.0));
  EXPECT_TRUE(track.at(5.0, 1.0));
  EXPECT_FALSE(PoseTrack().at(0.0, 1.0));
}

TEST(PoseTrack, SortsAndFindsOneTimeWithTwoPoses) {
  PoseTrack track;
  track.add(2.0, Pose(2, 0, 0, 0, 0, 0));
  track.add(1.0, Pose(1, 0, 0, 0, 0, 0));
  track.add(2.0, Pose(2, 0, 0, 0, 0, 0));
  track.finish();
  EXPECT_NEAR(track.at(1.5, 1.0)->x(), 1.5, 1e-12);

  PoseTrack clash;
  clash.add(2.0, Pose(2, 0, 0, 0, 0, 0));
  clash.add(1.0, Pose(1, 0, 0, 0, 0, 0));
  clash.add(2.0, Pose(3, 0, 0, 0, 0, 0));
  EXPECT_THROW(clash.finish(), InputError);
}

TEST(PoseTrack, RefusesWhatIsNoPose) {
  PoseTrack track;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(track.add(nan, Pose()), InputError);
  EXPECT_THROW(track.add(0.0, Pose(nan, 0, 0, 0, 0, 0)), InputError);
  EXPECT_THROW(track.add(0.0, Pose(0, 0, 0, nan, 0, 0)), InputError);
  EXPECT_TRUE(track.empty());
}

}  // namespace
}  // namespace hoctomap
