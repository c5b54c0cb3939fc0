// SPDX-License-Identifier: BSD-3-Clause
#include "building/BuildingScene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "hoctomap/geometry/Errors.h"
#include "hoctomap/simulation/Shape.h"
#include "hoctomap/simulation/ViewPath.h"
#include "measuring/FixedSolid.h"

namespace hoctomap {

namespace {

// Metres.
constexpr double kRoom = 5.0;
constexpr double kCorridor = 2.0;
constexpr double kWall = 0.1;
constexpr double kWallHeight = 2.5;
constexpr double kDoor = 0.9;
constexpr double kEye = 1.45;
constexpr double kAround = 1.15;                       // from the middle of a table to the camera
constexpr double kArc = 2.0 * std::numbers::pi / 3.0;  // radians around a table
const Eigen::Vector2d kTable(1.2, 0.8);
constexpr int kMostTables = 4;   // in a room
constexpr int kMostObjects = 8;  // on a table
constexpr int kWalkViews = 5;    // from table to table, and between waypoints

/// The i-th part of `whole` when it is cut into `parts` that differ by one at most.
int share(int whole, int parts, int i) {
  return whole / parts + (i < whole % parts ? 1 : 0);
}

struct Table {
  SolidId id;
  Eigen::Vector3d top;  ///< middle of its top
  double free_side;     ///< radians about z: where one can stand
};

class BuildingMaker {
 public:
  explicit BuildingMaker(const BuildingPlan& plan) : plan_(plan), random_(plan.seed * 7919 + 11) {
    if (plan.rooms < 2 || plan.rooms % 2 != 0 || plan.tables > kMostTables * plan.rooms || plan.tables < 1 ||
        plan.objects > kMostObjects * plan.tables || plan.objects < 0 || plan.width < 80) {
      throw ConfigError(
          "a building has an even number of rooms, at most 4 tables a room and 8 objects a table");
    }
    made_.seed = plan.seed;
    made_.sensor.edge_mixed = 0.02;
    const double focal = 540.0 * plan.width / 640.0;
    const int height = plan.width * 3 / 4;
    made_.sensor.camera = {plan.width, height, focal, focal, (plan.width - 1) / 2.0, (height - 1) / 2.0};
    arcViews();
  }

  Simulation make() && {
    const int columns = plan_.rooms / 2;
    addBox("floor", {columns * kRoom, 2.0 * kRoom + kCorridor, 0.1},
           {columns * kRoom / 2.0, kRoom + kCorridor / 2.0, -0.1});
    addOuterWalls(columns);
    for (int room = 0; room < plan_.rooms; ++room) visitRoom(room, columns);
    if (static_cast<int>(made_.views.size()) > plan_.scans)
      throw ConfigError("a walk through this building takes more scans");
    return std::move(made_);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void addBox(const std::string& name, const Eigen::Vector3d& size, const Eigen::Vector3d& foot) {
    addFixedSolid(made_.scene, name, BoxShape{size}, Pose(foot.x(), foot.y(), foot.z(), 0, 0, 0),
                  SolidLabel::background);
  }
  void addWall(const Eigen::Vector2d& from, const Eigen::Vector2d& to) {
    const Eigen::Vector2d middle = 0.5 * (from + to);
    const Eigen::Vector2d size = (to - from).cwiseAbs() + Eigen::Vector2d::Constant(kWall);
    addBox("wall" + std::to_string(++walls_), {size.x(), size.y(), kWallHeight},
           {middle.x(), middle.y(), 0.0});
  }
  void addOuterWalls(int columns) {
    const double length = columns * kRoom;
    const double depth = 2.0 * kRoom + kCorridor;
    for (const double y : {0.0, depth}) addWall({0.0, y}, {length, y});
    for (const double x : {0.0, length}) addWall({x, 0.0}, {x, depth});
  }

  /// Rooms are visited up the lower side of the corridor and down the upper one.
  void visitRoom(int room, int columns) {
    const bool upper = room >= columns;
    const int column = upper ? plan_.rooms - 1 - room : room;
    const double inwards = upper ? 1.0 : -1.0;  // from the corridor, along y
    const Eigen::Vector2d centre((column + 0.5) * kRoom, upper ? 1.5 * kRoom + kCorridor : 0.5 * kRoom);
    const double front = centre.y() - inwards * kRoom / 2.0;  // the wall to the corridor
    const double left = column * kRoom;
    addWall({left, front}, {centre.x() - kDoor / 2.0, front});
    addWall({centre.x() + kDoor / 2.0, front}, {left + kRoom, front});
    if (column > 0) addWall({left, centre.y() - kRoom / 2.0}, {left, centre.y() + kRoom / 2.0});

    const Eigen::Vector2d door(centre.x(), front);
    const Eigen::Vector2d before_door = door - Eigen::Vector2d(0.0, inwards * kCorridor / 2.0);
    if (room > 0) {
      walkTo(before_door);
      walkTo(centre);
    } else {
      at_ = centre;
    }
    for (const Table& table : furnish(room, centre)) lookAround(table, centre);
    walkTo(centre);
    walkTo(before_door);
  }

  /// Tables in the corners of a room, the first of them against the wall, and what stands on them.
  std::vector<Table> furnish(int room, const Eigen::Vector2d& centre) {
    std::vector<Table> tables;
    const int count = share(plan_.tables, plan_.rooms, room);
    for (int i = 0; i < count; ++i) {
      const Eigen::Vector2d corner(i == 0 || i == 3 ? 1.0 : -1.0, i < 2 ? 1.0 : -1.0);
      Eigen::Vector2d place = 1.35 * corner + Eigen::Vector2d(uniform(-0.1, 0.1), uniform(-0.1, 0.1));
      double yaw = uniform(-0.15, 0.15);
      if (i == 0) {
        place.y() = corner.y() * (kRoom / 2.0 - kWall / 2.0 - kTable.y() / 2.0);
        yaw = 0.0;
      }
      TableShape shape;
      shape.size = kTable;
      shape.height = uniform(0.68, 0.78);
      const Pose world_T_table(centre.x() + place.x(), centre.y() + place.y(), 0.0, yaw, 0.0, 0.0);
      const SolidId id = addFixedSolid(made_.scene, "table" + std::to_string(++tables_), shape, world_T_table,
                                       SolidLabel::table);
      put(id, share(plan_.objects, plan_.tables, tables_ - 1));
      tables.push_back(
          {id, {world_T_table.x(), world_T_table.y(), shape.height}, std::atan2(-corner.y(), -corner.x())});
    }
    return tables;
  }

  /// Objects in two rows, each in a cell of its own.
  void put(SolidId table, int objects) {
    std::vector<int> cells(kMostObjects);
    for (int i = 0; i < kMostObjects; ++i) cells[static_cast<std::size_t>(i)] = i;
    std::shuffle(cells.begin(), cells.end(), random_);
    for (int i = 0; i < objects; ++i) {
      const int cell = cells[static_cast<std::size_t>(i)];
      const double x = kTable.x() * ((cell % 4 + 0.5) / 4.0 - 0.5) * 0.93;
      const double y = (cell / 4 == 0 ? -0.19 : 0.19);
      Solid solid;
      const Shape shape = anything();
      solid.name = "thing" + std::to_string(++things_);
      solid.surface = std::make_shared<const TriangleMesh>(tessellate(shape));
      solid.support = table;
      solid.support_T_solid = Pose(x + uniform(-0.03, 0.03), y + uniform(-0.03, 0.03), 0.0,
                                   uniform(-std::numbers::pi, std::numbers::pi), 0.0, 0.0);
      made_.scene.add(std::move(solid));
    }
  }

  Shape anything() {
    const double kind = uniform(0.0, 1.0);
    if (kind < 0.5) return BoxShape{{uniform(0.05, 0.12), uniform(0.06, 0.14), uniform(0.05, 0.18)}};
    if (kind < 0.75) return CylinderShape{uniform(0.03, 0.05), uniform(0.07, 0.17)};
    TurnedShape turned;
    turned.wall = 0.004;
    if (kind < 0.9) {
      const double radius = uniform(0.035, 0.045);
      const double height = uniform(0.08, 0.11);
      turned.profile = {{0.9 * radius, 0.0}, {radius, height}};
      turned.handle = Handle{0.02, height - 0.02, 0.03, 0.006};
    } else {
      const double radius = uniform(0.055, 0.075);
      const double height = uniform(0.045, 0.06);
      for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
        turned.profile.emplace_back(radius * (0.45 + 0.55 * std::sqrt(t)), height * t);
    }
    return turned;
  }

  /// How many views are left for the arcs when the walking is done.
  void arcViews() {
    const int walks = 4 * plan_.rooms - 2 + 2 * plan_.tables;
    arc_views_ = plan_.scans - walks * kWalkViews;
    if (arc_views_ < 2 * plan_.tables) throw ConfigError("a walk through this building takes more scans");
  }

  /// Walks in a straight line and looks where it goes.
  void walkTo(const Eigen::Vector2d& to) {
    const Eigen::Vector2d from = at_;
    if ((to - from).norm() > 1e-3) heading_ = (to - from).normalized();
    const Eigen::Vector2d ahead = 1.5 * heading_;
    for (int i = 1; i <= kWalkViews; ++i) {
      at_ = from + (to - from) * i / kWalkViews;
      made_.views.push_back(
          lookAt({at_.x(), at_.y(), kEye}, {at_.x() + ahead.x(), at_.y() + ahead.y(), 0.8}));
    }
  }

  /// Comes by the middle of the room, and goes around the table as far as the walls let it.
  void lookAround(const Table& table, const Eigen::Vector2d& centre) {
    const int views = share(arc_views_, plan_.tables, visited_++);
    const auto eyeAt = [&](double angle) -> Eigen::Vector2d {
      return table.top.head<2>() + kAround * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    };
    const double begin = table.free_side - kArc / 2.0;
    walkTo(centre);
    walkTo(eyeAt(begin));
    for (int i = 0; i < views; ++i) {
      at_ = eyeAt(begin + kArc * i / (views - 1));
      made_.views.push_back(lookAt({at_.x(), at_.y(), kEye}, table.top));
    }
  }

  BuildingPlan plan_;
  std::mt19937_64 random_;
  Simulation made_;
  Eigen::Vector2d at_ = Eigen::Vector2d::Zero();
  Eigen::Vector2d heading_ = Eigen::Vector2d::UnitX();
  int arc_views_ = 0;
  int walls_ = 0;
  int tables_ = 0;
  int things_ = 0;
  int visited_ = 0;
};

}  // namespace

Simulation makeBuilding(const BuildingPlan& plan) {
  return BuildingMaker(plan).make();
}

}  // namespace hoctomap
