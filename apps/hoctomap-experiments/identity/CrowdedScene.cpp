// SPDX-License-Identifier: BSD-3-Clause
#include "identity/CrowdedScene.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "hoctomap/simulation/Shape.h"
#include "hoctomap/simulation/ViewPath.h"
#include "measuring/FixedSolid.h"

namespace hoctomap {

namespace {

constexpr double kTableHeight = 0.72;  // m
constexpr double kLeastStep = 0.01;    // m, between surfaces of two things that touch
const Eigen::Vector2d kTableSize(0.9, 1.3);

/// A shape, with what a neighbour must know of it.
struct Thing {
  std::string kind;
  Shape shape;
  double half_x = 0.0;  ///< m, along the row of its group
  double half_y = 0.0;
  double height = 0.0;
  bool has_top = false;  ///< others can stand on it
};

class SceneMaker {
 public:
  SceneMaker(std::uint64_t seed, int views) : random_(seed * 977 + 5) {
    scene_.name = "crowded_" + std::to_string(seed);
    Simulation& s = scene_.simulation;
    s.seed = seed;
    s.sensor.edge_mixed = 0.02;
    addFixedSolid(scene_.simulation.scene, "floor", BoxShape{{6.0, 6.0, 0.1}}, Pose(0, 0, -0.1, 0, 0, 0),
                  SolidLabel::background);
    TableShape table;
    table.size = kTableSize;
    table.height = kTableHeight;
    table_ = addFixedSolid(scene_.simulation.scene, "table", table, Pose(), SolidLabel::table);
    ArcPath path;
    path.radius = 0.85;
    path.height = kTableHeight + 0.6;
    path.angle_begin = -1.3;
    path.angle_end = 1.3;
    path.target = {0.0, 0.0, kTableHeight};
    path.views = views;
    s.views = sweep(path);
  }

  CrowdedScene make() && {
    const int groups = std::uniform_int_distribution<int>(2, 4)(random_);
    for (int g = 0; g < groups; ++g) {
      // Each group has a strip of the table to itself.
      const double y = kTableSize.y() * ((g + 0.5) / groups - 0.5);
      const Pose frame(uniform(-0.12, 0.12), y, 0.0, uniform(-0.5, 0.5), 0.0, 0.0);
      putGroup(frame);
    }
    return std::move(scene_);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

  Thing box(double most) {
    const Eigen::Vector3d size(uniform(0.05, most), uniform(0.06, 0.16), uniform(0.05, 0.18));
    return {"box", BoxShape{size}, size.x() / 2.0, size.y() / 2.0, size.z(), true};
  }
  Thing tin(double most) {
    const double radius = uniform(0.025, most / 2.0);
    const double height = uniform(0.07, 0.17);
    return {"tin", CylinderShape{radius, height}, radius, radius, height, true};
  }
  Thing mug() {
    TurnedShape shape;
    const double radius = uniform(0.035, 0.045);
    const double height = uniform(0.08, 0.11);
    shape.profile = {{0.9 * radius, 0.0}, {radius, height}};
    shape.wall = 0.004;
    shape.handle = Handle{0.02, height - 0.02, 0.03, 0.006};
    return {"mug", shape, radius, radius, height, false};
  }
  Thing bowl() {
    TurnedShape shape;
    const double radius = uniform(0.055, 0.075);
    const double height = uniform(0.045, 0.06);
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
      shape.profile.emplace_back(radius * (0.45 + 0.55 * std::sqrt(t)), height * t);
    shape.wall = 0.004;
    return {"bowl", shape, radius, radius, height, false};
  }

  /// Something to stand beside what is `beside` high: no view can part two tops that are flush.
  Thing standing(double beside) {
    for (;;) {
      Thing thing = anything();
      if (std::abs(thing.height - beside) > kLeastStep) return thing;
    }
  }
  Thing anything() {
    const double kind = uniform(0.0, 1.0);
    if (kind < 0.55) return box(0.12);
    if (kind < 0.8) return tin(0.1);
    return kind < 0.92 ? mug() : bowl();
  }
  /// Something that stands stably on a thing, narrower by a step on every side.
  Thing upper(const Thing& lower) {
    const double room = 2.0 * std::min(lower.half_x, lower.half_y) - 2.0 * kLeastStep;
    if (room > 0.09 && chance(0.25)) return mug();
    if (room > 0.055 && chance(0.3)) return tin(room);
    const Eigen::Vector3d size(2.0 * (lower.half_x - kLeastStep) * uniform(0.6, 1.0),
                               2.0 * (lower.half_y - kLeastStep) * uniform(0.6, 1.0), uniform(0.04, 0.12));
    return {"box", BoxShape{size}, size.x() / 2.0, size.y() / 2.0, size.z(), true};
  }

  SolidId put(const Thing& thing, std::optional<SolidId> support, const Pose& pose) {
    Solid solid;
    solid.name = thing.kind + std::to_string(++objects_);
    solid.surface = std::make_shared<const TriangleMesh>(tessellate(thing.shape));
    solid.top = thing.height;
    solid.support = support;
    solid.support_T_solid = pose;
    return scene_.simulation.scene.add(std::move(solid));
  }

  /// Things in a row, each against the one before, some of them with another one on top.
  void putGroup(const Pose& frame) {
    const int row = std::uniform_int_distribution<int>(1, 3)(random_);
    double x = 0.0;
    double height = 0.0;
    for (int i = 0; i < row; ++i) {
      const Thing thing = standing(height);
      height = thing.height;
      if (i > 0) x += thing.half_x + uniform(0.0, 0.003);
      const double side =
          thing.kind == "mug" ? std::numbers::pi * uniform(0.3, 0.7) : 0.0;  // handle off the row
      const SolidId id = put(thing, table_, frame + Pose(x, uniform(-0.03, 0.03), 0.0, side, 0.0, 0.0));
      x += thing.half_x;
      if (thing.has_top && (row == 1 || chance(0.45))) {
        const Thing top = upper(thing);
        put(top, id, Pose(uniform(-0.003, 0.003), uniform(-0.003, 0.003), 0.0, uniform(-0.1, 0.1), 0.0, 0.0));
      }
    }
  }

  std::mt19937_64 random_;
  CrowdedScene scene_;
  SolidId table_;
  int objects_ = 0;
};

}  // namespace

CrowdedScene makeCrowdedScene(std::uint64_t seed, int views) {
  return SceneMaker(seed, views).make();
}

}  // namespace hoctomap
