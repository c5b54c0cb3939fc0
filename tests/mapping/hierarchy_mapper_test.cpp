// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/mapping/HierarchyMapper.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "ScriptedMapper.h"
#include "hoctomap/geometry/Errors.h"

namespace hoctomap {
namespace {

using namespace test;  // the words of ScriptedMapper.h

TEST(HierarchyMapper, OneScanMakesTheTreeOfThePaper) {
  Mapper m;
  // Objects before their table in the scan: integration order is by structure, not by position.
  const UpdateReport report = m.integrate(Scan(0, {kCup, kBox, kTable, kFloor}));
  ASSERT_EQ(m.h().size(), 4U);
  const NodeId table{1};
  EXPECT_EQ(m.h().node(table).label(), labels::table);
  EXPECT_EQ(m.h().node(table).parent(), kRootId);
  EXPECT_EQ(m.h().node(table).children().size(), 2U);
  EXPECT_EQ(count(report, NodeEventKind::created), 3U);
  for (const NodeId object : m.h().node(table).children()) {
    EXPECT_EQ(m.h().node(object).label(), labels::object);
    EXPECT_NEAR(m.h().node(object).map().resolution(), 0.01, 1e-12);
    EXPECT_NEAR(m.h().node(object).existence(), 0.9, 1e-12);
  }
  EXPECT_GT(m.h().root().map().countVoxels().occupied, 0U);
}

TEST(HierarchyMapper, ANewNodeTakesTheFrameOfItsFirstSegment) {  // IV-A
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const auto& p : kCup.points) centroid += p.cast<double>() / static_cast<double>(kCup.points.size());
  const Pose world_T_cup = m.h().world_T_node(NodeId{2});
  EXPECT_LT((toIsometry(world_T_cup).translation() - centroid).norm(), 1e-6);
  // The world pose stays where it is when more of the object is seen.
  m.integrate(Scan(1, {kFloor, kTable, {Structure::cluster, patch(0.21, 0.1, 0.75, 0.05, 0.03, 0.05, 2)}}));
  EXPECT_EQ(m.h().size(), 3U);
  EXPECT_TRUE(toIsometry(m.h().world_T_node(NodeId{2})).isApprox(toIsometry(world_T_cup)));
}

TEST(HierarchyMapper, NodeMapsAreUpdatedInTheirOwnFrame) {  // Eq. (12)
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  const MapNode& cup = m.h().node(NodeId{2});
  const Eigen::Isometry3d node_T_world = toIsometry(m.h().world_T_node(NodeId{2})).inverse();
  for (const auto& p : kCup.points) {
    const Eigen::Vector3f q = (node_T_world * p.cast<double>()).cast<float>();
    const auto* voxel = cup.map().tree().search(q.x(), q.y(), q.z());
    ASSERT_NE(voxel, nullptr);
    EXPECT_TRUE(cup.map().tree().isNodeOccupied(voxel));
  }
  // Free space only inside the box of the node (IV-B).
  const Eigen::AlignedBox3d box = m.h().box(NodeId{2}).padded(0.011).box;
  for (auto leaf = cup.map().tree().begin_leafs(); leaf != cup.map().tree().end_leafs(); ++leaf) {
    EXPECT_TRUE(box.contains(Eigen::Vector3d(leaf.getX(), leaf.getY(), leaf.getZ())));
  }
}

TEST(HierarchyMapper, MonolithicEqualsStockInsertPointCloud) {
  test::Rng rng(7);
  MappingStrategies s;
  s.segmentation = makeWholeSegmentation();
  s.labeling = makeLabeling([](const Measurement&, const Segment&) { return labels::background; });
  s.association =
      makeAssociation([](const auto&, const auto&, const auto&) { return std::optional<NodeId>(); });
  HierarchyMapper mapper({1.5, false, false, {}}, profiles(), std::move(s));
  octomap::OcTree stock(0.1);
  for (std::uint64_t k = 0; k < 5; ++k) {
    const Eigen::Vector3d origin = test::uniformVector(rng, -0.5, 0.5);
    const Scan scan(k, {{Structure::remainder, test::boxSurface(rng, test::randomBox(rng, 1.0), 400)}},
                    origin);
    mapper.integrate(scan.z);
    octomap::Pointcloud cloud;
    for (const auto& p : scan.z.world_points) cloud.push_back(p.x(), p.y(), p.z());
    stock.insertPointCloud(
        cloud,
        {static_cast<float>(origin.x()), static_cast<float>(origin.y()), static_cast<float>(origin.z())},
        1.5);
    std::ostringstream expected;
    stock.write(expected);
    ASSERT_EQ(otBytes(mapper.hierarchy().root().map()), expected.str()) << "scan " << k;
  }
  EXPECT_EQ(mapper.hierarchy().size(), 1U);
}

TEST(HierarchyMapper, AContradictedNodeTakesNoSegment) {
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  (*m.evidence)[NodeId{2}] = seen(false);
  // Something else stands in the box of the cup, which the beams say is gone.
  const UpdateReport report = m.integrate(Scan(1, {kFloor, kTable, kCup}));
  EXPECT_EQ(count(report, NodeEventKind::created), 1U);
  EXPECT_EQ(m.h().node(NodeId{2}).last_scan, 0U);
  EXPECT_TRUE(m.h().contains(NodeId{3}));
}

TEST(HierarchyMapper, ANodeDiesWhenItsExistenceFallsBelowOneHalf) {  // Eq. (8)
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  (*m.evidence)[NodeId{2}] = seen(true);
  m.integrate(Scan(1, {kFloor, kTable, kCup}));
  (*m.evidence)[NodeId{2}] = seen(false);
  const UpdateReport first = m.integrate(Scan(2, {kFloor, kTable}));
  EXPECT_TRUE(m.h().contains(NodeId{2}));
  ASSERT_EQ(first.existence.size(), 1U);
  EXPECT_NEAR(first.existence[0].p_posterior, m.h().node(NodeId{2}).existence(), 1e-15);
  const UpdateReport second = m.integrate(Scan(3, {kFloor, kTable}));
  EXPECT_FALSE(m.h().contains(NodeId{2}));
  EXPECT_EQ(count(second, NodeEventKind::removed), 1U);
  ASSERT_EQ(m.mapper.removed().size(), 1U);
  EXPECT_EQ(m.mapper.removed()[0].node.id(), NodeId{2});
  EXPECT_EQ(m.mapper.removed()[0].removed_scan, 3U);
}

TEST(HierarchyMapper, AHiddenNodeKeepsItsProbabilityExactly) {
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  Evidence hidden;
  hidden.occluded = 250;
  (*m.evidence)[NodeId{2}] = hidden;
  const double before = m.h().node(NodeId{2}).existence_log_odds;
  for (std::uint64_t k = 1; k <= 50; ++k) m.integrate(Scan(k, {kFloor, kTable}));
  EXPECT_EQ(m.h().node(NodeId{2}).existence_log_odds, before);
}

TEST(HierarchyMapper, ChildrenOfARemovedTableStayWhereTheyAre) {
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  const auto before = toIsometry(m.h().world_T_node(NodeId{2}));
  (*m.evidence)[NodeId{1}] = seen(false);
  m.integrate(Scan(1, {kFloor}));
  m.integrate(Scan(2, {kFloor}));
  EXPECT_FALSE(m.h().contains(NodeId{1}));
  EXPECT_EQ(m.h().node(NodeId{2}).parent(), kRootId);
  EXPECT_TRUE(toIsometry(m.h().world_T_node(NodeId{2})).isApprox(before, 1e-9));
}

TEST(HierarchyMapper, AnObjectSeenBeforeItsTableIsAdoptedByIt) {
  Mapper m;
  m.integrate(Scan(0, {kFloor, kCup}));
  EXPECT_EQ(m.h().node(NodeId{1}).parent(), kRootId);
  const auto before = toIsometry(m.h().world_T_node(NodeId{1}));
  m.integrate(Scan(1, {kFloor, kTable}));
  EXPECT_EQ(m.h().node(NodeId{1}).parent(), NodeId{2});
  EXPECT_TRUE(toIsometry(m.h().world_T_node(NodeId{1})).isApprox(before, 1e-9));
}

TEST(HierarchyMapper, APerceivedMotionMovesTheSubtree) {  // III-D
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  const auto cup_before = toIsometry(m.h().world_T_node(NodeId{2}));
  const auto table_before = toIsometry(m.h().world_T_node(NodeId{1}));
  ObjectMotion motion;
  motion.node = NodeId{1};
  motion.motion = Pose(0.1, 0.2, 0.0, 0.3, 0, 0);
  const UpdateReport report = m.mapper.integrate(motion, 1);
  EXPECT_EQ(count(report, NodeEventKind::moved), 1U);
  const auto moved = toIsometry(motion.motion);
  EXPECT_TRUE(toIsometry(m.h().world_T_node(NodeId{1})).isApprox(table_before * moved, 1e-9));
  EXPECT_TRUE(toIsometry(m.h().world_T_node(NodeId{2}))
                  .isApprox(table_before * moved * table_before.inverse() * cup_before, 1e-9));
  motion.node = NodeId{99};
  const UpdateReport ignored = m.mapper.integrate(motion, 1);
  EXPECT_TRUE(ignored.events.empty());
  EXPECT_EQ(ignored.warnings.size(), 1U);
}

TEST(HierarchyMapper, SegmentsOfOneNodeUpdateEachVoxelOnce) {
  Mapper whole;
  Mapper split;
  whole.integrate(Scan(0, {kFloor, kTable, kBox}));
  split.integrate(Scan(0, {kFloor, kTable, kBox}));
  const PointCloud again = patch(-0.3, 0.0, 0.78, 0.05, 0.04, 0.07, 9);
  const PointCloud first(again.begin(), again.begin() + 150);
  const PointCloud second(again.begin() + 150, again.end());
  whole.integrate(Scan(1, {kFloor, kTable, {Structure::cluster, again}}));
  split.integrate(Scan(1, {kFloor, kTable, {Structure::cluster, first}, {Structure::cluster, second}}));
  EXPECT_EQ(otBytes(whole.h().node(NodeId{2}).map()), otBytes(split.h().node(NodeId{2}).map()));
}

TEST(HierarchyMapper, CarvingByTheWholeScanClearsWhatOwnBeamsDoNot) {
  // A stain of background in mid-air; later beams pass through it and end on the cup.
  const Piece stain{Structure::remainder, patch(0.14, 0.07, 1.15, 0.02, 0.02, 0.02)};
  for (const Carve carve : {Carve::own, Carve::scan}) {
    Mapper m;
    LabelProfiles p = profiles();
    p[labels::background].carve = carve;
    HierarchyMapper mapper(MappingConfig{}, p, m.strategies());
    const Scan first(0, {kFloor, stain});
    *m.current = &first;
    mapper.integrate(first.z);
    for (std::uint64_t k = 1; k < 12; ++k) {
      const Scan scan(k, {{Structure::remainder, {kFloor.points.front()}}, kTable, kCup});
      *m.current = &scan;
      mapper.integrate(scan.z);
    }
    const auto& tree = mapper.hierarchy().root().map().tree();
    const auto* voxel = tree.search(0.15, 0.05, 1.15);
    ASSERT_NE(voxel, nullptr);
    EXPECT_EQ(tree.isNodeOccupied(voxel), carve == Carve::own);
  }
}

/// The top of a box, seen again and again from the same flat angle. Beams end in a third of its voxels a
/// scan.
TEST(HierarchyMapper, BeamsThatGrazeASurfaceDoNotThinItOut) {
  for (const Grazing grazing : {Grazing::clear, Grazing::spare}) {
    Mapper m;
    LabelProfiles fine = profiles();
    fine[labels::object].resolution = 0.002;
    fine[labels::object].grazing = grazing;
    HierarchyMapper mapper(MappingConfig{}, fine, m.strategies());
    test::Rng rng(7);
    PointCloud all;
    for (std::uint64_t k = 0; k < 8; ++k) {
      PointCloud top;
      for (int i = 0; i < 400; ++i) {
        const Eigen::Vector3d at = 0.1 * test::uniformVector(rng, 0.0, 1.0);
        top.push_back(Eigen::Vector3d(at.x(), at.y(), 1.0 + 0.02 * at.z()).cast<float>());  // 2 mm of noise
      }
      all.insert(all.end(), top.begin(), top.end());
      const Scan scan(k, {{Structure::cluster, top}}, {-1.0, 0.05, 1.2});  // 11 degrees
      *m.current = &scan;
      mapper.integrate(scan.z);
    }
    const NodeId box{1};
    const Eigen::Isometry3d node_T_world = toIsometry(mapper.hierarchy().world_T_node(box)).inverse();
    const auto& tree = mapper.hierarchy().node(box).map().tree();
    const auto is_occupied = [&](const Eigen::Vector3f& p) {
      const Eigen::Vector3f at = (node_T_world * p.cast<double>()).cast<float>();
      const auto* voxel = tree.search(at.x(), at.y(), at.z());
      return voxel != nullptr && tree.isNodeOccupied(voxel);
    };
    const double kept = static_cast<double>(std::count_if(all.begin(), all.end(), is_occupied)) /
                        static_cast<double>(all.size());
    if (grazing == Grazing::spare) {
      EXPECT_GT(kept, 0.95);
    } else {
      EXPECT_LT(kept, 0.75);
    }
  }
}

TEST(HierarchyMapper, TheNumberOfThreadsChangesNothing) {
  std::vector<std::string> results;
  for (const std::size_t threads : {1U, 4U}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    Mapper m;
    for (std::uint64_t k = 0; k < 4; ++k) {
      m.integrate(Scan(k, {kFloor, kTable, kCup, kBox}, {0.1 * static_cast<double>(k), 0.0, 2.0}));
    }
    std::string all;
    for (const NodeId id : m.h().ids()) all += otBytes(m.h().node(id).map());
    results.push_back(all);
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(HierarchyMapper, ALabelWithoutAProfileIsAConfigurationError) {
  Mapper m;
  MappingStrategies s = m.strategies();
  s.labeling = makeLabeling([](const Measurement&, const Segment&) { return Label{"lamp"}; });
  HierarchyMapper mapper(MappingConfig{}, profiles(), std::move(s));
  const Scan scan(0, {kCup});
  *m.current = &scan;
  EXPECT_THROW(mapper.integrate(scan.z), ConfigError);
  EXPECT_EQ(mapper.hierarchy().size(), 1U);
  EXPECT_THROW(HierarchyMapper(MappingConfig{}, {}, m.strategies()), ConfigError);
}

TEST(HierarchyMapper, AnEmptyScanChangesNothing) {
  Mapper m;
  m.integrate(Scan(0, {kFloor, kTable, kCup}));
  const std::string before = otBytes(m.h().node(NodeId{2}).map());
  const UpdateReport report = m.integrate(Scan(1, {}));
  EXPECT_TRUE(report.events.empty());
  EXPECT_EQ(report.points, 0U);
  EXPECT_EQ(otBytes(m.h().node(NodeId{2}).map()), before);
}

}  // namespace
}  // namespace hoctomap
