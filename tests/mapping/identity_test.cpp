// SPDX-License-Identifier: BSD-3-Clause
// One object is one node, in whatever order the scans come (docs/decisions/0028).
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

#include "ScriptedMapper.h"
#include "hoctomap/mapping/ScanSeams.h"

namespace hoctomap {
namespace {

using namespace test;  // the words of ScriptedMapper.h

/// The front of a box: a point every 3 mm.
PointCloud front(double y_min, double y_max, double z_min, double z_max, double x = 0.2) {
  PointCloud points;
  for (double y = y_min; y < y_max; y += 0.003) {
    for (double z = z_min; z < z_max; z += 0.003) points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  }
  return points;
}

PointCloud both(PointCloud a, const PointCloud& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Two boxes whose fronts are a step apart, and a wall that S may cut in two.
const PointCloud kLeft = front(-0.10, 0.0, 0.7, 0.8);
const PointCloud kRight = front(0.0, 0.10, 0.7, 0.8, 0.18);
const PointCloud kFlushRight = front(0.0, 0.10, 0.7, 0.8);
const Piece kLeftPiece{Structure::cluster, kLeft};
const Piece kRightPiece{Structure::cluster, kRight};
const Piece kBothPiece{Structure::cluster, both(kLeft, kRight)};
const Eigen::Vector3d kOrigin{2.0, 0.0, 1.2};

MappingConfig bySurface() {
  MappingConfig config;
  config.seam_votes = true;
  config.reidentification.enabled = false;
  return config;
}

struct Result {
  std::size_t objects = 0;
  std::size_t splits = 0;
  std::size_t merges = 0;
  std::size_t voxels = 0;
};

/// Scans of two things: 'a'part, or 'j'oined in one segment.
Result mapSequence(const std::string& views, const PointCloud& right = kRight) {
  const Piece right_piece{Structure::cluster, right};
  const Piece both_piece{Structure::cluster, both(kLeft, right)};
  Mapper m(bySurface());
  Result result;
  for (std::size_t k = 0; k < views.size(); ++k) {
    for (const NodeId id : m.h().ids()) (*m.evidence)[id] = seen(true);
    const Scan scan = views[k] == 'a' ? Scan(k, {kFloor, kTable, kLeftPiece, right_piece}, kOrigin)
                                      : Scan(k, {kFloor, kTable, both_piece}, kOrigin);
    const UpdateReport report = m.integrate(scan);
    result.splits += count(report, NodeEventKind::split);
    result.merges += count(report, NodeEventKind::merged);
  }
  for (const NodeId id : m.h().ids()) {
    if (m.h().node(id).label() != labels::object) continue;
    ++result.objects;
    result.voxels += m.h().node(id).map().occupiedVoxels().size();
  }
  return result;
}

TEST(Identity, WhatOneGoodViewShowsApartIsTwoInAnyOrder) {
  for (std::size_t at = 0; at < 6; ++at) {
    std::string views = "jjjjjj";
    views[at] = 'a';
    EXPECT_EQ(mapSequence(views).objects, 2U) << views;
  }
}

TEST(Identity, ASmoothSurfaceIsOneWhoeverCutsIt) {
  std::string views = "aajj";
  do {
    EXPECT_EQ(mapSequence(views, kFlushRight).objects, 1U) << views;
  } while (std::next_permutation(views.begin(), views.end()));
}

TEST(Identity, ASplitIsOneEventAndLosesNothing) {
  const Result joined = mapSequence("j");
  EXPECT_EQ(joined.objects, 1U);
  const Result split = mapSequence("ja");
  EXPECT_EQ(split.objects, 2U);
  EXPECT_EQ(split.splits, 1U);
  EXPECT_EQ(split.merges, 0U);
  EXPECT_GE(split.voxels, joined.voxels);  // those on the seam are measured for both
}

TEST(Identity, ASegmentThatBridgesTwoNodesIsDivided) {
  Mapper m(bySurface());
  m.integrate(Scan(0, {kFloor, kTable, kLeftPiece, kRightPiece}, kOrigin));
  for (const NodeId id : m.h().ids()) (*m.evidence)[id] = seen(true);
  const Eigen::AlignedBox3d before = m.h().node(NodeId{2}).map().occupiedBox();
  m.integrate(Scan(1, {kFloor, kTable, kBothPiece}, kOrigin));
  EXPECT_TRUE(before.isApprox(m.h().node(NodeId{2}).map().occupiedBox(), 0.011));
  EXPECT_EQ(m.h().node(NodeId{3}).last_scan, 1U);
}

/// A level face: a point every 3 mm.
PointCloud level(double x_min, double x_max, double y_min, double y_max, double z) {
  PointCloud points;
  for (double x = x_min; x < x_max; x += 0.003) {
    for (double y = y_min; y < y_max; y += 0.003) points.push_back(Eigen::Vector3d(x, y, z).cast<float>());
  }
  return points;
}

// A table from its left end to its right, and one that stands at an angle to it.
const Piece kLeftEnd{Structure::plane, level(-0.6, -0.3, -0.4, 0.4, 0.7)};
const Piece kRightEnd{Structure::plane, level(0.2, 0.6, -0.4, 0.4, 0.7)};
const Piece kWholeTable{Structure::plane, level(-0.6, 0.6, -0.4, 0.4, 0.7)};

TEST(Identity, ATableSeenInPartsIsOneWhenItIsSeenWhole) {
  const Piece on_left{Structure::cluster, front(-0.05, 0.05, 0.7, 0.8, -0.45)};
  std::vector<Scan> scans{Scan(0, {kFloor, kLeftEnd, on_left}, kOrigin),
                          Scan(1, {kFloor, kRightEnd}, kOrigin), Scan(2, {kFloor, kWholeTable}, kOrigin)};
  Mapper m(bySurface());
  m.integrate(scans[0]);
  const NodeId left{1};
  const NodeId object{2};
  m.integrate(scans[1]);
  const NodeId right{3};
  ASSERT_EQ(m.h().node(left).label(), labels::table);
  ASSERT_EQ(m.h().node(right).label(), labels::table);
  ASSERT_EQ(m.h().node(object).parent(), left);
  const UpdateReport report = m.integrate(scans[2]);
  EXPECT_EQ(count(report, NodeEventKind::merged), 1U);
  EXPECT_FALSE(m.h().contains(left));  // the larger one goes on
  EXPECT_EQ(m.h().node(object).parent(), right);
  EXPECT_GE(m.h().node(right).map().occupiedVoxels().size(), 24U * 16U);  // of 5 cm: 1.2 by 0.8 m
}

TEST(Identity, TablesWhoseBoxesMeetStayApart) {
  PointCloud turned;  // beside the whole table, its corner all but in the middle of its side
  for (const auto& p : level(0.0, 0.6, 0.0, 0.6, 0.7))
    turned.push_back(Eigen::AngleAxisf(0.785F, Eigen::Vector3f::UnitZ()) * p + Eigen::Vector3f(0, 0.45F, 0));
  const Piece beside{Structure::plane, turned};
  Mapper m(bySurface());
  for (std::uint64_t k = 0; k < 6; ++k) {
    const UpdateReport report = m.integrate(Scan(k, {kFloor, kWholeTable, beside}, kOrigin));
    EXPECT_EQ(count(report, NodeEventKind::merged), 0U);
  }
}

/// The front of one thing seen from ahead, the back of one seen from behind, and what stands on both.
std::size_t objectsUnderLoad(double height_of_back) {
  const PointCloud load_top = level(0.2, 0.26, -0.04, 0.04, 0.9);
  const Piece front_side{Structure::cluster,
                         both(front(-0.1, 0.1, 0.7, 0.81, 0.3), level(0.27, 0.3, -0.1, 0.1, 0.81))};
  const Piece back_side{Structure::cluster, both(front(-0.1, 0.1, 0.7, height_of_back, 0.16),
                                                 level(0.16, 0.19, -0.1, 0.1, height_of_back))};
  const Piece load_ahead{Structure::cluster, both(front(-0.04, 0.04, 0.815, 0.9, 0.26), load_top)};
  const Piece load_behind{Structure::cluster, both(front(-0.04, 0.04, 0.815, 0.9, 0.2), load_top)};
  Mapper m(bySurface());
  for (std::uint64_t k = 0; k < 4; ++k) {
    for (const NodeId id : m.h().ids()) (*m.evidence)[id] = seen(true);
    m.integrate(k % 2 == 0 ? Scan(k, {kFloor, kTable, front_side, load_ahead}, {2.0, 0.0, 1.2})
                           : Scan(k, {kFloor, kTable, back_side, load_behind}, {-2.0, 0.0, 1.2}));
  }
  const auto ids = m.h().ids();
  return static_cast<std::size_t>(std::count_if(
      ids.begin(), ids.end(), [&](NodeId id) { return m.h().node(id).label() == labels::object; }));
}

TEST(Identity, SidesAsHighThatCarryTheSameThingAreOne) {
  EXPECT_EQ(objectsUnderLoad(0.81), 2U);
  EXPECT_EQ(objectsUnderLoad(0.76), 3U) << "one of them ends lower";
}

TEST(SeamVotes, CountScansInWhateverOrderTheyCome) {
  const PointCloud whole = both(kLeft, kRight);
  const std::vector<const PointCloud*> apart{&kLeft, &kRight};
  const std::vector<const PointCloud*> joined{&whole};
  SeamVotes a;
  SeamVotes b;
  EXPECT_EQ(a.add(scanSeams(apart, {}, kOrigin)), SeamVotes::cellsOf(whole));
  a.add(scanSeams(joined, {}, kOrigin));
  b.add(scanSeams(joined, {}, kOrigin));
  b.add(scanSeams(apart, {}, kOrigin));
  EXPECT_EQ(a, b);
  EXPECT_TRUE(a.meet(SeamVotes::cellsOf(kLeft), SeamVotes::cellsOf(kRight)));
  EXPECT_TRUE(a.meet(SeamVotes::cellsOf(kRight), SeamVotes::cellsOf(kLeft)));
}

TEST(SeamVotes, WhatDoesNotMeetHasNoSeam) {
  const PointCloud far = front(0.2, 0.3, 0.7, 0.8);
  SeamVotes seams;
  seams.add(scanSeams(std::vector<const PointCloud*>{&kLeft, &far}, {}, kOrigin));
  EXPECT_FALSE(seams.meet(SeamVotes::cellsOf(kLeft), SeamVotes::cellsOf(far)));
}

TEST(SeamVotes, GroundBesideAnObjectVotesForASeamOnly) {
  const std::vector<const PointCloud*> object{&kLeft};
  const std::vector<const PointCloud*> ground{&kRight};
  SeamVotes seams;
  // The object's cells are shown, the ground's are none of an object.
  EXPECT_EQ(seams.add(scanSeams(object, ground, kOrigin)), SeamVotes::cellsOf(kLeft));
  const auto of_ground = SeamVotes::cellsOf(kRight);
  int against = 0;
  for (const auto& [cell, votes] : seams.all()) {
    EXPECT_EQ(votes.is_object, SeamVotes::cellsOf(kLeft).contains(cell));
    for (std::size_t d = 0; d < SeamVotes::kDirections; ++d) {
      if (!votes.known[d] || of_ground.contains(cell) == of_ground.contains(SeamVotes::partner(cell, d)))
        continue;
      EXPECT_GT(votes.evidence[d], 0);
      ++against;
    }
  }
  EXPECT_GT(against, 20);
}

// Against a flood over all cells; what is far away is not even looked at.
TEST(SeamVotes, ObjectsAroundAreAllThatHangTogetherWithTheSeeds) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Rng rng(seed);
    const auto draw = [&rng](std::int32_t low, std::int32_t high) {
      return std::uniform_int_distribution<std::int32_t>(low, high)(rng);
    };
    SeamVotes seams;
    std::vector<SeamVotes::Cell> all;
    for (int blob = 0; blob < 40; ++blob) {
      SeamVotes::Cell at{draw(-90, 90), draw(-90, 90), draw(40, 60)};
      for (int k = 0; k < 30; ++k) {
        at = {at.x + draw(-2, 2), at.y + draw(-2, 2), at.z};
        SeamVotes::Votes votes;
        votes.is_object = true;
        seams.set(at, votes);
        all.push_back(at);
      }
    }
    seams.set({500, 500, 50}, {.is_object = true, .known = {}, .evidence = {}});
    const SeamVotes::Cells seeds{all.front()};
    SeamVotes::Cells expected = seeds;
    std::vector<SeamVotes::Cell> open{all.front()};
    while (!open.empty()) {
      const SeamVotes::Cell c = open.back();
      open.pop_back();
      for (const auto& o : all) {
        if (std::max({std::abs(o.x - c.x), std::abs(o.y - c.y), std::abs(o.z - c.z)}) > 2) continue;
        if (expected.insert(o).second) open.push_back(o);
      }
    }
    std::vector<SeamVotes::Cell> found;
    for (const auto* entry : seams.objectsAround(seeds)) found.push_back(entry->first);
    EXPECT_TRUE(std::is_sorted(found.begin(), found.end()));
    EXPECT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end())) << seed;
    EXPECT_LT(found.back().x, 500);
  }
}

TEST(SeamVotes, WhatIsForgottenLeavesNothing) {
  SeamVotes seams;
  const auto cells = seams.add(scanSeams(std::vector<const PointCloud*>{&kLeft, &kRight}, {}, kOrigin));
  const auto left = SeamVotes::cellsOf(kLeft);
  seams.forget(left);
  EXPECT_FALSE(seams.meet(left, SeamVotes::cellsOf(kRight)));
  seams.forget(cells);
  EXPECT_EQ(seams, SeamVotes());
}

}  // namespace
}  // namespace hoctomap
