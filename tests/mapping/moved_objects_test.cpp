// SPDX-License-Identifier: BSD-3-Clause
// Nodes that a scan shows elsewhere (III-D).
#include <gtest/gtest.h>

#include "ScriptedMapper.h"

namespace hoctomap {
namespace {

using namespace test;  // the words of ScriptedMapper.h

/// An L of two plates, so that its turn is seen, at a place on the table.
Piece angle(double x, double y, double yaw, double arm = 0.12) {
  Rng rng(7);
  const Eigen::Isometry3d motion =
      Eigen::Translation3d(x, y, 0.0) * Eigen::Isometry3d(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
  Piece piece{Structure::cluster, {}};
  for (int i = 0; i < 3000; ++i) {
    const bool first = i % 3 != 0;
    const Eigen::Vector3d p(first ? uniform(rng, 0.0, arm) : 0.0, first ? 0.0 : uniform(rng, 0.0, 0.06),
                            uniform(rng, 0.71, 0.79));
    piece.points.push_back((motion * p).cast<float>());
  }
  return piece;
}

class MovedObjects : public testing::Test {
 protected:
  MovedObjects() {
    m_.integrate(Scan(0, {kFloor, kTable, angle(-0.2, 0.0, 0.0)}));
    m_.integrate(Scan(1, {kFloor, kTable, angle(-0.2, 0.0, 0.0)}));
    (*m_.evidence)[kObject] = seen(false);
  }

  const NodeId kObject{2};
  Mapper m_;
};

TEST_F(MovedObjects, KeepTheirNodeAndMap) {
  const Eigen::Vector3d before = toIsometry(m_.h().world_T_node(kObject)).translation();
  const auto voxels = m_.h().node(kObject).map().countVoxels().occupied;
  const UpdateReport report = m_.integrate(Scan(2, {kFloor, kTable, angle(0.2, 0.15, 0.6)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 1U);
  EXPECT_EQ(count(report, NodeEventKind::created), 0U);
  EXPECT_EQ(count(report, NodeEventKind::removed), 0U);
  EXPECT_EQ(count(report, NodeEventKind::moved), 0U);
  ASSERT_TRUE(m_.h().contains(kObject));
  EXPECT_EQ(m_.h().node(kObject).parent(), NodeId{1});
  EXPECT_GE(m_.h().node(kObject).map().countVoxels().occupied, voxels);
  EXPECT_GT(m_.h().node(kObject).existence(), 0.9);  // this scan shows it
  const Eigen::Isometry3d motion = Eigen::Translation3d(0.2, 0.15, 0.0) *
                                   Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitZ()) *
                                   Eigen::Translation3d(0.2, 0.0, 0.0);
  EXPECT_LT((toIsometry(m_.h().world_T_node(kObject)).translation() - motion * before).norm(), 0.01);
}

TEST_F(MovedObjects, OfOtherShapeAreNewNodes) {
  const UpdateReport report = m_.integrate(Scan(2, {kFloor, kTable, angle(0.2, 0.15, 0.6, 0.2)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 0U);
  EXPECT_EQ(count(report, NodeEventKind::created), 1U);
  m_.integrate(Scan(3, {kFloor, kTable, angle(0.2, 0.15, 0.6, 0.2)}));
  EXPECT_FALSE(m_.h().contains(kObject));  // two clear views without it
}

TEST_F(MovedObjects, ThatLookAlikeAreReportedAndNotGuessed) {
  const UpdateReport report =
      m_.integrate(Scan(2, {kFloor, kTable, angle(0.2, 0.15, 0.6), angle(0.2, -0.25, 0.0)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 0U);
  EXPECT_EQ(count(report, NodeEventKind::created), 2U);
  EXPECT_FALSE(report.warnings.empty());
}

TEST_F(MovedObjects, ThatAreStillThereAreNotSought) {
  (*m_.evidence)[kObject] = seen(true);
  const UpdateReport report =
      m_.integrate(Scan(2, {kFloor, kTable, angle(-0.2, 0.0, 0.0), angle(0.2, 0.15, 0.6)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 0U);
  EXPECT_EQ(count(report, NodeEventKind::created), 1U);
}

}  // namespace
}  // namespace hoctomap
