// SPDX-License-Identifier: BSD-3-Clause
#include "changes/ChangeRun.h"

#include <gtest/gtest.h>

#include "changes/Reliability.h"

namespace hoctomap {
namespace {

constexpr int kWidth = 640;  // pixels, as a Kinect

TEST(Reliability, OfWhatIsAlwaysSureAndRightIsPerfect) {
  const std::vector<ExistenceCheck> checks{{1.0, true}, {0.0, false}, {1.0, true}};
  const Reliability r = reliabilityOf(checks);
  EXPECT_DOUBLE_EQ(r.brier, 0.0);
  EXPECT_EQ(r.bins[9].count, 2U);
  EXPECT_EQ(r.bins[0].count, 1U);
  EXPECT_DOUBLE_EQ(r.bins[9].share_existing, 1.0);
}

TEST(Reliability, BinsHoldMeansAndTheScoreIsBriers) {
  const std::vector<ExistenceCheck> checks{{0.82, true}, {0.88, false}};
  const Reliability r = reliabilityOf(checks);
  EXPECT_NEAR(r.bins[8].mean_probability, 0.85, 1e-12);
  EXPECT_NEAR(r.bins[8].share_existing, 0.5, 1e-12);
  EXPECT_NEAR(r.brier, (0.18 * 0.18 + 0.88 * 0.88) / 2.0, 1e-12);
  EXPECT_NEAR(r.brier_constant, 0.25, 1e-12);
}

TEST(ChangeScript, OfTheSameSeedIsTheSame) {
  const auto a = makeChangeScript(ScriptKind::pair, 3, kWidth).simulation;
  const auto b = makeChangeScript(ScriptKind::pair, 3, kWidth).simulation;
  ASSERT_EQ(a.scene.size(), b.scene.size());
  for (const SolidId id : a.scene.ids()) {
    EXPECT_EQ(a.scene.solid(id).name, b.scene.solid(id).name);
    EXPECT_EQ(a.scene.world_T_solid(id).asString(), b.scene.world_T_solid(id).asString());
  }
}

TEST(ChangeRun, ATableCarriesItsObjects) {  // III-D
  const ChangeResult result =
      runChangeScript(makeChangeScript(ScriptKind::table, 2, kWidth), loadSettings(std::nullopt));
  EXPECT_EQ(result.counts.right, 1) << (result.mistakes.empty() ? "" : result.mistakes.front());
  EXPECT_EQ(result.counts.false_alarms + result.counts.missed, 0);
  ASSERT_EQ(result.motions.size(), 1U);
  EXPECT_LT(result.motions[0].shift, 0.01);
  EXPECT_LT(result.motions[0].turn, 0.035);
}

TEST(ChangeRun, LookAlikesThatExchangeTheirPlacesAreNoChange) {
  const ChangeResult result =
      runChangeScript(makeChangeScript(ScriptKind::swap, 2, kWidth), loadSettings(std::nullopt));
  EXPECT_EQ(result.counts.right + result.counts.false_alarms + result.counts.missed, 0);
}

}  // namespace
}  // namespace hoctomap
