// SPDX-License-Identifier: BSD-3-Clause
// HierarchyQuery against an oracle that looks at every voxel, 100,000 random probes a kind.
#include "hoctomap/query/HierarchyQuery.h"

#include <gtest/gtest.h>

#include <numeric>
#include <thread>

#include "QueryOracle.h"

namespace hoctomap {
namespace {

constexpr int kHierarchies = 20;
constexpr int kProbes = 5000;  // of each

/// Calls `probe(query, oracle, rng)` 100,000 times over random hierarchies.
template <class Probe>
void probeAll(std::uint64_t seed, const Probe& probe) {
  test::Rng rng(seed);
  for (int i = 0; i < kHierarchies && !::testing::Test::HasFailure(); ++i) {
    const MapHierarchy map = test::randomHierarchy(rng);
    const HierarchyQuery query(map);
    const test::QueryOracle oracle(map);
    for (int k = 0; k < kProbes && !::testing::Test::HasFailure(); ++k) probe(query, oracle, rng);
  }
}

Obb randomBox(test::Rng& rng, double largest) {
  Obb box;
  box.world_T_frame = toIsometry(test::randomPose(rng, 0.5));
  const Eigen::Vector3d half = test::uniformVector(rng, 0.001, 0.5 * largest);
  box.box = Eigen::AlignedBox3d(-half, half);
  return box;
}

TEST(HierarchyQuery, PointsAreThoseOfTheOracle) {
  std::map<Occupancy, int> seen;
  probeAll(1, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Eigen::Vector3d p = test::uniformVector(rng, -0.3, 0.3);
    const PointAnswer expected = oracle.at(p);
    const PointAnswer answer = query.at(p);
    EXPECT_EQ(answer.state, expected.state) << p.transpose();
    EXPECT_EQ(answer.node, expected.node) << p.transpose();
    EXPECT_NEAR(answer.probability, expected.probability, 1e-9);
    ++seen[answer.state];
  });
  for (const auto& [state, count] : seen) EXPECT_GT(count, 5000) << static_cast<int>(state);
}

TEST(HierarchyQuery, RaysAreThoseOfTheOracle) {
  std::map<RayAnswer::End, int> seen;
  probeAll(2, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Eigen::Vector3d origin = test::uniformVector(rng, -0.5, 0.5);
    const Eigen::Vector3d direction = test::uniformVector(rng, -2.0, 2.0);
    RayOptions options;
    options.ignore_unknown = rng() % 4 != 0;
    if (rng() % 2 == 0) options.max_range = test::uniform(rng, 0.0, 1.0);
    const RayAnswer expected = oracle.castRay(origin, direction, options);
    const RayAnswer answer = query.castRay(origin, direction, options);
    ASSERT_EQ(answer.end, expected.end) << origin.transpose() << " to " << direction.transpose();
    EXPECT_EQ(answer.node, expected.node);
    ++seen[answer.end];
    if (answer.end == RayAnswer::End::nothing) return;
    EXPECT_NEAR(answer.distance, expected.distance, 1e-8);
    EXPECT_LT((answer.point - expected.point).norm(), 1e-8);
  });
  for (const auto& [end, count] : seen) EXPECT_GT(count, 5000) << static_cast<int>(end);
}

TEST(HierarchyQuery, BoxesCollideAsTheOracleSays) {
  int hits = 0;
  probeAll(3, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Obb box = randomBox(rng, 0.2);
    const auto answer = query.collision(box);
    EXPECT_EQ(answer, oracle.collision(box));
    hits += answer ? 1 : 0;
  });
  EXPECT_GT(hits, 20000);
  EXPECT_LT(hits, 80000);
}

TEST(HierarchyQuery, SpheresCollideAsTheOracleSays) {
  int hits = 0;
  probeAll(4, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Eigen::Vector3d centre = test::uniformVector(rng, -0.4, 0.4);
    const double radius = test::uniform(rng, 0.0, 0.1);
    const auto answer = query.collision(centre, radius);
    EXPECT_EQ(answer, oracle.collision(centre, radius));
    hits += answer ? 1 : 0;
  });
  EXPECT_GT(hits, 20000);
  EXPECT_LT(hits, 80000);
}

TEST(HierarchyQuery, TheNearestVoxelIsThatOfTheOracle) {
  probeAll(5, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Eigen::Vector3d p = test::uniformVector(rng, -1.0, 1.0);
    const double most =
        rng() % 2 == 0 ? test::uniform(rng, 0.0, 1.0) : std::numeric_limits<double>::infinity();
    const auto expected = oracle.nearestOccupied(p, most);
    const auto answer = query.nearestOccupied(p, most);
    ASSERT_EQ(answer.has_value(), expected.has_value()) << p.transpose() << " within " << most;
    if (!answer) return;
    EXPECT_NEAR(answer->distance, expected->distance, 1e-9);
    EXPECT_NEAR((answer->point - p).norm(), answer->distance, 1e-9);
    EXPECT_EQ(answer->node, expected->node) << p.transpose();
  });
}

TEST(HierarchyQuery, UnknownSharesAreThoseOfTheOracle) {
  probeAll(6, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Obb box = randomBox(rng, 0.4);
    const double step = 0.6 * box.box.sizes().maxCoeff();
    EXPECT_NEAR(query.unknownShare(box, step), oracle.unknownShare(box, step), 1e-9);
  });
}

TEST(HierarchyQuery, TheNodesOfARegionAreThoseOfTheOracle) {
  std::size_t found = 0;
  probeAll(7, [&](const HierarchyQuery& query, const test::QueryOracle& oracle, test::Rng& rng) {
    const Obb region = randomBox(rng, 0.3);
    const auto expected = oracle.nodesIn(region);
    const auto answer = query.nodesIn(region);
    ASSERT_EQ(answer.size(), expected.size());
    for (std::size_t i = 0; i < answer.size(); ++i) {
      EXPECT_EQ(answer[i].node, expected[i].node);
      EXPECT_NEAR(answer[i].share, expected[i].share, 1e-9);
    }
    found += answer.size();
  });
  EXPECT_GT(found, 20000U);
}

TEST(HierarchyQuery, WhatIsLessLikelyToExistCanBeLeftOut) {
  test::Rng rng(8);
  const MapHierarchy map = test::randomHierarchy(rng);
  const HierarchyQuery query(map, {.min_existence = 0.8});
  const test::QueryOracle oracle(map, 0.8);
  for (int k = 0; k < 2000; ++k) {
    const Eigen::Vector3d p = test::uniformVector(rng, -0.4, 0.4);
    const auto answer = query.at(p);
    EXPECT_EQ(answer.node, oracle.at(p).node);
    if (answer.node) {
      EXPECT_GE(map.node(*answer.node).existence(), 0.8);
    }
  }
}

/// A node with one voxel of 10 cm, and over it a finer one that knows the lower half of it to be free.
MapHierarchy twoNodes() {
  auto coarse = std::make_unique<octomap::OcTree>(0.1);
  coarse->setNodeValue(0.05, 0.05, 0.05, 3.0F);
  MapHierarchy map(labels::background, {std::move(coarse), OccupancyModel{}});
  auto fine = std::make_unique<octomap::OcTree>(0.05);
  for (const double x : {0.02, 0.07}) {
    for (const double y : {0.02, 0.07}) fine->setNodeValue(x, y, 0.02, -2.0F);
  }
  map.add(labels::object, {std::move(fine), OccupancyModel{}}, Pose(), kRootId);
  map.node(NodeId{1}).existence_log_odds = std::log(3.0);  // 0.75
  return map;
}

TEST(HierarchyQuery, TheFinerNodeDecidesWhereItKnows) {
  const MapHierarchy map = twoNodes();
  const HierarchyQuery query(map);
  EXPECT_EQ(query.at({0.05, 0.05, 0.08}).state, Occupancy::occupied);
  EXPECT_EQ(query.at({0.05, 0.05, 0.08}).node, kRootId);
  const PointAnswer free = query.at({0.06, 0.06, 0.02});
  EXPECT_EQ(free.state, Occupancy::free);
  EXPECT_EQ(free.node, NodeId{1});
  const double voxel = 1.0 / (1.0 + std::exp(2.0));
  EXPECT_NEAR(free.probability, 0.75 * voxel + 0.25 * 0.5, 1e-7);
  // A ray from below goes on to where the finer node knows nothing.
  const RayAnswer hit = query.castRay({0.06, 0.06, -1.0}, {0.0, 0.0, 1.0}, {.ignore_unknown = true});
  EXPECT_EQ(hit.end, RayAnswer::End::hit);
  EXPECT_NEAR(hit.distance, 1.05, 1e-12);
  EXPECT_EQ(hit.node, kRootId);
  // For safety the whole coarse voxel counts.
  EXPECT_EQ(query.collision({0.06, 0.06, 0.02}, 0.001), kRootId);
  EXPECT_EQ(query.nearestOccupied({0.06, 0.06, -0.3})->distance, 0.3);
}

TEST(HierarchyQuery, TheUnknownShareOfABoxIsThatOfItsVolume) {
  const MapHierarchy map = twoNodes();
  const HierarchyQuery query(map);
  const auto box = [](double from, double to) {
    return Obb{Eigen::Isometry3d::Identity(),
               Eigen::AlignedBox3d(Eigen::Vector3d(0.0, 0.0, from), Eigen::Vector3d(0.1, 0.1, to))};
  };
  EXPECT_EQ(query.unknownShare(box(0.0, 0.1)), 0.0);
  EXPECT_EQ(query.unknownShare(box(-0.1, 0.1)), 0.5);
  EXPECT_EQ(query.unknownShare(box(-0.3, 0.1)), 0.75);
  EXPECT_EQ(query.unknownShare(box(5.0, 6.0)), 1.0);
}

TEST(HierarchyQuery, RaysAlongVoxelFacesEndWhereTheyShould) {
  const MapHierarchy map = twoNodes();
  const HierarchyQuery query(map);
  for (const double x : {0.0, 0.05}) {  // on a face: the voxel above it
    const auto hit = query.castRay({x, 0.05, 1.0}, {0.0, 0.0, -3.0}, {.ignore_unknown = true});
    EXPECT_EQ(hit.end, RayAnswer::End::hit);
    EXPECT_NEAR(hit.distance, 0.9, 1e-12);
  }
  const auto past = query.castRay({0.1, 0.05, 1.0}, {0.0, 0.0, -1.0}, {.ignore_unknown = true});
  EXPECT_EQ(past.end, RayAnswer::End::nothing);
  EXPECT_THROW(static_cast<void>(query.castRay({0, 0, 0}, {0, 0, 0})), std::invalid_argument);
}

TEST(HierarchyQuery, AnEmptyMapKnowsNothing) {
  const MapHierarchy map(labels::background, NodeMap(0.1, {}));
  const HierarchyQuery query(map);
  EXPECT_EQ(query.at({0, 0, 0}).state, Occupancy::unknown);
  EXPECT_EQ(query.castRay({0, 0, 0}, {1, 0, 0}).end, RayAnswer::End::unknown);
  EXPECT_EQ(query.castRay({0, 0, 0}, {1, 0, 0}, {.ignore_unknown = true}).end, RayAnswer::End::nothing);
  EXPECT_FALSE(query.collision({0, 0, 0}, 10.0));
  EXPECT_FALSE(query.nearestOccupied({0, 0, 0}));
}

TEST(HierarchyQuery, ManyThreadsMayAskAtOnce) {
  test::Rng rng(9);
  const MapHierarchy map = test::randomHierarchy(rng);
  const HierarchyQuery query(map);
  std::vector<Eigen::Vector3d> points(20000);
  for (auto& p : points) p = test::uniformVector(rng, -0.4, 0.4);
  std::vector<std::vector<PointAnswer>> answers(4, std::vector<PointAnswer>(points.size()));
  {
    std::vector<std::jthread> threads;
    for (auto& own : answers) threads.emplace_back([&] { query.at(points, own); });
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (const auto& own : answers) EXPECT_EQ(own[i].node, query.at(points[i]).node);
  }
  EXPECT_THROW(query.at(points, std::span(answers[0]).first(3)), std::invalid_argument);
}

}  // namespace
}  // namespace hoctomap
