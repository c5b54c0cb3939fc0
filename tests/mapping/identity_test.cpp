// SPDX-License-Identifier: BSD-3-Clause
// One object is one node, in whatever order the scans come (docs/decisions/0023).
#include <gtest/gtest.h>

#include "ScriptedMapper.h"
#include "hoctomap/mapping/SeamVotes.h"

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

const PointCloud kLeft = front(-0.10, 0.0, 0.7, 0.8);
const PointCloud kRight = front(0.0, 0.10, 0.7, 0.8);
const Piece kLeftPiece{Structure::cluster, kLeft};
const Piece kRightPiece{Structure::cluster, kRight};
const Piece kBothPiece{Structure::cluster, both(kLeft, kRight)};

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

/// Scans of the two boxes that touch: 'a'part, or 'j'oined in one segment.
Result mapSequence(const std::string& views) {
  Mapper m(bySurface());
  Result result;
  for (std::size_t k = 0; k < views.size(); ++k) {
    for (const NodeId id : m.h().ids()) (*m.evidence)[id] = seen(true);
    const Scan scan = views[k] == 'a' ? Scan(k, {kFloor, kTable, kLeftPiece, kRightPiece})
                                      : Scan(k, {kFloor, kTable, kBothPiece});
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

TEST(Identity, WhatEnoughViewsShowApartIsTwoInAnyOrder) {
  std::string views = "aajj";
  do {
    EXPECT_EQ(mapSequence(views).objects, 2U) << views;
  } while (std::next_permutation(views.begin(), views.end()));
}

TEST(Identity, WhatNearlyAllViewsShowAsOneIsOneInAnyOrder) {
  for (std::size_t at = 0; at < 7; ++at) {
    std::string views = "jjjjjjj";
    views[at] = 'a';
    views += 'j';
    const Result result = mapSequence(views);
    EXPECT_EQ(result.objects, 1U) << views;
  }
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
  m.integrate(Scan(0, {kFloor, kTable, kLeftPiece, kRightPiece}));
  for (const NodeId id : m.h().ids()) (*m.evidence)[id] = seen(true);
  const Eigen::AlignedBox3d before = m.h().node(NodeId{2}).map().occupiedBox();
  m.integrate(Scan(1, {kFloor, kTable, kBothPiece}));
  EXPECT_TRUE(before.isApprox(m.h().node(NodeId{2}).map().occupiedBox(), 0.011));
  EXPECT_EQ(m.h().node(NodeId{3}).last_scan, 1U);
}

TEST(SeamVotes, CountScansInWhateverOrderTheyCome) {
  const PointCloud whole = both(kLeft, kRight);
  const std::vector<const PointCloud*> apart{&kLeft, &kRight};
  const std::vector<const PointCloud*> joined{&whole};
  SeamVotes a;
  SeamVotes b;
  a.add(apart);
  a.add(joined);
  b.add(joined);
  b.add(apart);
  EXPECT_EQ(a, b);
  const auto verdict = a.between(SeamVotes::cellsOf(kLeft), SeamVotes::cellsOf(kRight));
  EXPECT_GT(verdict.pairs, 10.0);
  EXPECT_EQ(verdict.joined + verdict.apart, 2.0 * verdict.pairs);
  EXPECT_NEAR(verdict.apart, verdict.pairs, 0.5 * verdict.pairs);
  const auto back = a.between(SeamVotes::cellsOf(kRight), SeamVotes::cellsOf(kLeft));
  EXPECT_EQ(back.apart, verdict.apart);
  EXPECT_EQ(back.joined, verdict.joined);
}

TEST(SeamVotes, WhatDoesNotMeetHasNoSeam) {
  const PointCloud far = front(0.2, 0.3, 0.7, 0.8);
  SeamVotes seams;
  seams.add(std::vector<const PointCloud*>{&kLeft, &far});
  EXPECT_EQ(seams.between(SeamVotes::cellsOf(kLeft), SeamVotes::cellsOf(far)).pairs, 0.0);
}

}  // namespace
}  // namespace hoctomap
