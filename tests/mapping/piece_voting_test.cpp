// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include "ScriptedMapper.h"

namespace hoctomap {
namespace {

using namespace test;  // the words of ScriptedMapper.h

/// Two clusters side by side, and both as one cluster.
struct TwoPieces {
  Piece whole{Structure::cluster, patch(-0.3, 0.0, 0.78, 0.1, 0.05, 0.07)};
  Piece piece{Structure::cluster, patch(-0.17, 0.0, 0.78, 0.02, 0.02, 0.02)};
  Piece joined = whole;
  TwoPieces() { joined.points.insert(joined.points.end(), piece.points.begin(), piece.points.end()); }
};

TEST(PieceVoting, APieceJoinsTheNodeThatViewsShowItToBePartOf) {
  const TwoPieces p;
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, p.whole, p.piece}));
  const NodeId whole{2};
  const NodeId piece{3};
  const Eigen::Vector3d at = toIsometry(m.h().world_T_node(piece)).translation();
  (*m.evidence)[whole] = (*m.evidence)[piece] = seen(true);
  EXPECT_EQ(count(m.integrate(Scan(1, {kFloor, kTable, p.joined})), NodeEventKind::merged), 0U) << "one view";
  EXPECT_EQ(count(m.integrate(Scan(2, {kFloor, kTable, p.joined})), NodeEventKind::merged), 1U);
  EXPECT_FALSE(m.h().contains(piece));
  ASSERT_EQ(m.mapper.removed().size(), 1U);
  EXPECT_TRUE(m.h().box(whole).contains(at));
}

TEST(PieceVoting, WhatMostViewsShowApartStaysApart) {
  const TwoPieces p;
  // Of like size: a tie of votes must not merge them.
  const Piece other{Structure::cluster, patch(-0.08, 0.0, 0.78, 0.09, 0.05, 0.07)};
  Piece joined = p.whole;
  joined.points.insert(joined.points.end(), other.points.begin(), other.points.end());
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, p.whole, other}));
  (*m.evidence)[NodeId{2}] = (*m.evidence)[NodeId{3}] = seen(true);
  for (std::uint64_t k = 1; k <= 5; ++k) m.integrate(Scan(k, {kFloor, kTable, p.whole, other}));
  for (std::uint64_t k = 6; k <= 10; ++k) m.integrate(Scan(k, {kFloor, kTable, joined}));
  EXPECT_TRUE(m.h().contains(NodeId{2}));
  ASSERT_TRUE(m.h().contains(NodeId{3}));
  EXPECT_EQ(m.h().node(NodeId{3}).votes.joined, 5U);
}

TEST(PieceVoting, AHiddenPieceCastsNoVote) {
  const TwoPieces p;
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, p.whole, p.piece}));
  Evidence hidden;
  hidden.occluded = 100;
  (*m.evidence)[NodeId{3}] = hidden;
  for (std::uint64_t k = 1; k < 6; ++k) m.integrate(Scan(k, {kFloor, kTable, p.joined}));
  EXPECT_TRUE(m.h().contains(NodeId{3}));
  EXPECT_EQ(m.h().node(NodeId{3}).votes.joined, 0U);
}

}  // namespace
}  // namespace hoctomap
