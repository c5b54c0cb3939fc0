// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/existence/BeamExistenceModel.h"

#include <gtest/gtest.h>

#include "support/RandomScenes.h"

namespace hoctomap {
namespace {

/// A wall 2 m ahead and a square plate of 12 cm at a chosen distance, as a depth image; sideways offset in y.
struct Plate {
  double distance = 1.2;
  double y = 0.0;
  bool there = true;
};

Measurement look(const std::vector<Plate>& plates, double pose_error_y = 0.0) {
  DepthImage image{{160, 120, 145.0, 145.0, 80.0, 60.0}, std::vector<float>(160 * 120, 2.0F)};
  for (const Plate& plate : plates) {
    if (!plate.there) continue;
    for (int v = 0; v < 120; ++v) {
      for (int u = 0; u < 160; ++u) {
        const Eigen::Vector3d p = image.camera.point(u, v, plate.distance);
        float& depth = image.depth[static_cast<std::size_t>(v * 160 + u)];
        if (std::abs(p.y() - plate.y) < 0.06 && std::abs(p.z()) < 0.06 && plate.distance < depth) {
          depth = static_cast<float>(plate.distance);
        }
      }
    }
  }
  return unproject(std::move(image), Pose(0.0, pose_error_y, 0.0, 0, 0, 0), {});
}

/// A hierarchy whose only node but the root holds the plate at 1.2 m, seen from the origin.
struct MappedPlate {
  MapHierarchy h{labels::background, NodeMap(0.05, {})};
  NodeId plate = h.add(labels::object, NodeMap(0.005, {}), Pose(1.2, 0, 0, 0, 0, 0), kRootId);

  MappedPlate() {
    const Measurement z = look({{1.2}});
    PointCloud wall;
    PointCloud on_plate;
    for (const auto& p : z.world_points) {
      if (p.x() < 1.5F) {
        on_plate.emplace_back(p.x() - 1.2F, p.y(), p.z());
      } else {
        wall.push_back(p);
      }
    }
    update(kRootId, wall, Eigen::Vector3f::Zero());
    update(plate, on_plate, Eigen::Vector3f(-1.2F, 0, 0));
  }

  void update(NodeId id, const PointCloud& hits, const Eigen::Vector3f& origin) {
    Beams beams;
    beams.hits = hits;
    beams.origin = origin;
    h.node(id).map().update(*makeReferenceScanUpdate(), beams);
  }

  [[nodiscard]] Evidence see(const Measurement& z, bool same_view = false) const {
    return BeamExistenceModel({}).evidence(h, z, {{plate, {}, same_view}}).front();
  }
};

TEST(BeamExistenceModel, ANodeThatIsSeenIsPresent) {
  const Evidence e = MappedPlate().see(look({{1.2}}));
  EXPECT_TRUE(e.informative);
  EXPECT_GT(e.present, 20 * (e.absent + e.occluded));
  EXPECT_GT(e.p_measurement, 0.85);
  EXPECT_FALSE(e.contradicts());
}

TEST(BeamExistenceModel, ANodeThatBeamsPassThroughIsAbsent) {
  const Evidence e = MappedPlate().see(look({}));
  EXPECT_TRUE(e.informative);
  EXPECT_GT(e.absent, 20 * (e.present + e.occluded));
  EXPECT_LT(e.p_measurement, 0.15);
  EXPECT_TRUE(e.contradicts());
}

TEST(BeamExistenceModel, AHiddenNodeNeverChanges) {
  const MappedPlate scene;
  const ExistenceParameters parameters;
  // Something 24 cm wide stands before it, whether or not the plate is still there.
  for (const bool there : {true, false}) {
    const Evidence e = scene.see(look({{1.2, 0.0, there}, {0.5, 0.0}, {0.5, 0.03}, {0.5, -0.03}}));
    EXPECT_FALSE(e.informative);
    EXPECT_FALSE(e.in_sight);
    EXPECT_EQ(e.p_measurement, parameters.prior);
    EXPECT_GT(e.occluded, 10 * (e.present + e.absent));
  }
}

TEST(BeamExistenceModel, ANodeOutOfViewNeverChanges) {
  const MappedPlate scene;
  Measurement z = look({});
  z.world_T_sensor = Pose(0, 0, 0, M_PI, 0, 0);  // looking the other way
  const Evidence e = scene.see(z);
  EXPECT_EQ(e.present + e.absent + e.occluded, 0U);
  EXPECT_EQ(e.p_measurement, 0.5);
}

TEST(BeamExistenceModel, NoReturnIsNeverFreeSpace) {
  Measurement z = look({});
  for (float& depth : z.image->depth) depth = 0.0F;
  const Evidence e = MappedPlate().see(z);
  EXPECT_FALSE(e.informative);
  EXPECT_EQ(e.absent, 0U);
}

TEST(BeamExistenceModel, APoseErrorIsSearchedOut) {
  const MappedPlate scene;
  for (const double error : {-0.015, 0.015}) {
    const Evidence e = scene.see(look({{1.2, -error}}, error));
    const Evidence shifted = scene.see(look({{1.2}}, error));
    EXPECT_GT(e.p_measurement, 0.85) << "seen where it is";
    EXPECT_GT(shifted.p_measurement, 0.85) << "seen " << error << " m beside it";
  }
}

TEST(BeamExistenceModel, AnUnorganisedCloudSaysTheSame) {
  const MappedPlate scene;
  for (const bool there : {true, false}) {
    Measurement z = look({{1.2, 0.0, there}});
    z.image.reset();
    z.pixel_of_point.clear();
    const Evidence e = scene.see(z);
    EXPECT_TRUE(e.informative);
    EXPECT_EQ(e.contradicts(), !there);
  }
}

TEST(BeamExistenceModel, FromWhereANodeWasMappedThereIsNoPoseError) {
  const MappedPlate scene;
  const Measurement moved = look({{1.2, 0.03}, {1.215, -0.05}});  // two others, where the plate was
  EXPECT_GT(scene.see(moved).presentShare(), scene.see(moved, true).presentShare());
  EXPECT_GT(scene.see(look({{1.2}}), true).p_measurement, 0.85);
  EXPECT_TRUE(scene.see(look({{1.222}}), true).contradicts()) << "two centimetres behind it";
  EXPECT_FALSE(scene.see(look({{1.222}})).contradicts()) << "an error of the pose";
}

/// A plate before a board that carries it, and what a noisy scan of both says of the plate.
/// @param gap     m, from the plate as it is mapped to the board
/// @param behind  m, from the plate as it is mapped to where the scan has it: far views make surfaces thick
Evidence seePlateOnBoard(double gap, double behind, bool there, std::uint64_t seed) {
  MappedPlate scene;
  const double board_at = 1.2 + gap;
  const NodeId board = scene.h.add(labels::table, NodeMap(0.01, {}), Pose(board_at, 0, 0, 0, 0, 0), kRootId);
  scene.h.reparent(scene.plate, board);
  PointCloud hits;
  for (double y = -0.3; y < 0.3; y += 0.004)
    for (double z = -0.3; z < 0.3; z += 0.004) hits.push_back(Eigen::Vector3d(1e-4, y, z).cast<float>());
  scene.update(board, hits, Eigen::Vector3d(-board_at, 0, 0).cast<float>());
  test::Rng rng(seed);
  std::normal_distribution<double> noise;
  Measurement z = look({{1.2 + behind, 0.0, there}});
  for (float& depth : z.image->depth) {
    const double range = depth > 1.9F ? board_at : static_cast<double>(depth);
    depth = static_cast<float>(range + 0.0015 * range * range * noise(rng));
  }
  return scene.see(z, true);
}

TEST(BeamExistenceModel, WhatIsNearerToItsSupportThanBeamsCanTellIsNotDisputed) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const double gap : {0.000, 0.002, 0.004})  // the centres of the board's voxels are 5 mm behind it
      for (const double behind : {0.0, 0.004, 0.008})
        EXPECT_FALSE(seePlateOnBoard(gap, behind, true, seed).contradicts()) << gap << " " << behind;
    EXPECT_TRUE(seePlateOnBoard(0.004, 0.0, false, seed).in_sight);
    EXPECT_TRUE(seePlateOnBoard(0.05, 0.0, false, seed).contradicts()) << seed;
  }
}

/// Whether all is the same.
bool same(const Evidence& a, const Evidence& b) {
  return a.present == b.present && a.absent == b.absent && a.occluded == b.occluded &&
         a.informative == b.informative && a.p_measurement == b.p_measurement;
}

TEST(BeamExistenceModel, NodesElsewhereChangeNothing) {
  MappedPlate alone;
  MappedPlate crowd;
  const PointCloud few{{0.0F, 0.0F, 0.0F}, {0.02F, 0.0F, 0.0F}};
  std::vector<NodeInQuestion> nodes{{crowd.plate, {}}};
  for (const auto& [x, y, z] :
       {std::tuple{-1.0, 0.0, 0.0}, {1.2, 3.0, 0.0}, {1.2, 0.0, -4.0}, {9.0, 0.0, 0.0}}) {
    const NodeId table = crowd.h.add(labels::table, NodeMap(0.01, {}), Pose(x, y, z, 0, 0, 0), kRootId);
    crowd.update(table, few, Eigen::Vector3f(-1, 0, 0));
    const NodeId object = crowd.h.add(labels::object, NodeMap(0.01, {}), Pose(x, y, z, 0, 0, 0), table);
    crowd.update(object, few, Eigen::Vector3f(-1, 0, 0));
    nodes.push_back({table, {}});
    nodes.push_back({object, {}});
  }
  const BeamExistenceModel model({});
  const Measurement z = look({{1.2}});
  const auto evidence = model.evidence(crowd.h, z, nodes);
  EXPECT_TRUE(same(evidence.front(), alone.see(z)));
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    EXPECT_TRUE(same(evidence[i], {0, 0, 0, false, 0.5})) << i;
  }
  const Eigen::AlignedBox3d reach = model.reach(z);
  EXPECT_TRUE(reach.contains(worldBounds(crowd.h.box(crowd.plate))));
  EXPECT_FALSE(reach.intersects(worldBounds(crowd.h.box(nodes.back().id)))) << "beyond the farthest return";
}

}  // namespace
}  // namespace hoctomap
