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

/// A floor and a wall, seen by so many beams that the root knows where the space above the table was free.
std::vector<Piece> room() {
  std::vector<Piece> pieces{{Structure::remainder, patch(1.5, 0.0, 1.0, 0.01, 1.0, 1.0)}};
  for (std::uint64_t seed = 1; seed <= 25; ++seed) {
    pieces.push_back({Structure::remainder, patch(0.0, 0.0, 0.0, 0.8, 0.8, 0.01, seed)});
  }
  return pieces;
}

Scan withRoom(std::uint64_t number, const std::vector<Piece>& things) {
  std::vector<Piece> pieces = room();
  pieces.insert(pieces.end(), things.begin(), things.end());
  return {number, pieces};
}

class MovedObjects : public testing::Test {
 protected:
  MovedObjects() {
    m_.integrate(withRoom(0, {kTable, angle(-0.2, 0.0, 0.0)}));
    m_.integrate(withRoom(1, {kTable, angle(-0.2, 0.0, 0.0)}));
    (*m_.evidence)[kObject] = seen(false);
  }

  const NodeId kObject{2};
  Mapper m_;
};

TEST_F(MovedObjects, KeepTheirNodeAndMap) {
  const Eigen::Vector3d before = toIsometry(m_.h().world_T_node(kObject)).translation();
  const auto voxels = m_.h().node(kObject).map().countVoxels().occupied;
  const UpdateReport report = m_.integrate(withRoom(2, {kTable, angle(0.2, 0.15, 0.6)}));
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
  const UpdateReport report = m_.integrate(withRoom(2, {kTable, angle(0.2, 0.15, 0.6, 0.2)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 0U);
  EXPECT_EQ(count(report, NodeEventKind::created), 1U);
  m_.integrate(withRoom(3, {kTable, angle(0.2, 0.15, 0.6, 0.2)}));
  EXPECT_FALSE(m_.h().contains(kObject));  // two clear views without it
}

TEST_F(MovedObjects, ThatLookAlikeAreReportedAndNotGuessed) {
  const UpdateReport report =
      m_.integrate(withRoom(2, {kTable, angle(0.2, 0.15, 0.6), angle(0.2, -0.25, 0.0)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 0U);
  EXPECT_EQ(count(report, NodeEventKind::created), 2U);
  EXPECT_FALSE(report.warnings.empty());
}

TEST_F(MovedObjects, ThatAreStillThereAreNotSought) {
  (*m_.evidence)[kObject] = seen(true);
  const UpdateReport report =
      m_.integrate(withRoom(2, {kTable, angle(-0.2, 0.0, 0.0), angle(0.2, 0.15, 0.6)}));
  EXPECT_EQ(count(report, NodeEventKind::reidentified), 0U);
  EXPECT_EQ(count(report, NodeEventKind::created), 1U);
}

TEST_F(MovedObjects, ThatAppearedBeforeTheOldPlaceWasSeenEmptyGetTheirNodeBack) {
  (*m_.evidence)[kObject] = Evidence{};  // out of view
  const UpdateReport appears = m_.integrate(withRoom(2, {kTable, angle(0.2, 0.15, 0.6)}));
  ASSERT_EQ(count(appears, NodeEventKind::created), 1U);
  const NodeId again{3};
  (*m_.evidence)[kObject] = seen(false);
  (*m_.evidence)[again] = seen(true);
  const UpdateReport empty = m_.integrate(withRoom(3, {kTable, angle(0.2, 0.15, 0.6)}));
  EXPECT_EQ(count(empty, NodeEventKind::reidentified), 1U);
  EXPECT_EQ(count(empty, NodeEventKind::merged), 1U);
  EXPECT_EQ(count(empty, NodeEventKind::removed), 0U);
  ASSERT_TRUE(m_.h().contains(kObject));
  EXPECT_FALSE(m_.h().contains(again));
  EXPECT_GT(m_.h().node(kObject).existence(), 0.9);
  const Eigen::Vector3d at = m_.h().box(kObject).center();
  EXPECT_LT((at - angle(0.2, 0.15, 0.6).points[0].cast<double>()).norm(), 0.15);
}

// What was found of two nodes is what would be found now, also when one of them has changed since.
TEST_F(MovedObjects, WhatIsRememberedOfTwoNodesHoldsUntilOneChanges) {
  const ReidentificationConfig config;
  const std::map<NodeId, Evidence> support;
  (*m_.evidence)[kObject] = Evidence{};  // out of view
  m_.integrate(withRoom(2, {kTable, angle(0.2, 0.15, 0.6)}));
  const NodeId again{3};
  (*m_.evidence)[again] = seen(true);
  LateMatches remembering;
  const auto found = [&](LateMatches& matches, std::uint64_t scan) {
    const auto match = matches.find(m_.h(), kObject, scan, support, config);
    return match ? std::optional(match->again) : std::nullopt;
  };
  for (const std::uint64_t scan : {3U, 4U, 4U}) EXPECT_EQ(found(remembering, scan), again) << scan;
  m_.integrate(withRoom(5, {kTable, angle(0.2, 0.15, 0.6, 0.25)}));  // it is larger than it seemed
  for (const std::uint64_t scan : {5U, 6U, 7U}) {
    LateMatches fresh;
    EXPECT_EQ(found(remembering, scan), found(fresh, scan)) << scan;
    EXPECT_EQ(found(remembering, scan), std::nullopt) << scan;
  }
}

TEST(ReplacedObjects, AreRemovedAndTheirSuccessorIsANewNode) {
  // A low plate, seen from above, and then a tall box in its place: the beams end on the box, where the plate
  // would hide behind it, so that nothing contradicts the plate but the space that was free.
  Mapper m;
  const auto plate = Piece{Structure::cluster, patch(0.2, 0.1, 0.72, 0.06, 0.06, 0.005)};
  const auto tall = Piece{Structure::cluster, patch(0.2, 0.1, 1.03, 0.07, 0.07, 0.32)};
  const auto floor = Piece{Structure::remainder, patch(0.2, 0.1, 0.0, 0.7, 0.7, 0.01)};
  const auto wall = Piece{Structure::remainder, patch(1.5, 0.0, 1.0, 0.01, 1.0, 1.0)};
  for (std::uint64_t k = 0; k < 3; ++k) m.integrate(Scan(k, {floor, wall, kTable, plate}));
  const NodeId old{2};
  ASSERT_TRUE(m.h().contains(old));
  Evidence& support = (*m.evidence)[old] = seen(true);
  support.present = 80;  // at its edges the new one is not as wide
  support.absent = 20;
  std::size_t created = 0;
  std::size_t removed = 0;
  for (std::uint64_t k = 3; k < 8; ++k) {
    const UpdateReport report = m.integrate(Scan(k, {floor, wall, kTable, tall}));
    created += count(report, NodeEventKind::created);
    removed += count(report, NodeEventKind::removed);
  }
  EXPECT_EQ(created, 1U);
  EXPECT_EQ(removed, 1U);
  EXPECT_FALSE(m.h().contains(old));
}

TEST(ReplacedObjects, AnObjectOfWhichMoreIsSeenIsTheSame) {
  Mapper m;
  const auto left = Piece{Structure::cluster, patch(0.2, 0.1, 0.75, 0.04, 0.03, 0.04, 2)};
  const auto whole = Piece{Structure::cluster, patch(0.23, 0.1, 0.75, 0.07, 0.03, 0.04, 3)};
  for (std::uint64_t k = 0; k < 3; ++k) m.integrate(Scan(k, {kFloor, kTable, left}));
  (*m.evidence)[NodeId{2}] = seen(true);
  const UpdateReport report = m.integrate(Scan(3, {kFloor, kTable, whole}));
  EXPECT_EQ(count(report, NodeEventKind::created), 0U);
  EXPECT_EQ(count(report, NodeEventKind::removed), 0U);
}

}  // namespace
}  // namespace hoctomap
