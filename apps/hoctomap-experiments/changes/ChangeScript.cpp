// SPDX-License-Identifier: BSD-3-Clause
#include "changes/ChangeScript.h"

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <stdexcept>

#include "hoctomap/simulation/Shape.h"
#include "measuring/FixedSolid.h"

namespace hoctomap {

namespace {

constexpr double kTableHeight = 0.72;  // m
const Eigen::Vector2d kTableSize(0.9, 1.2);
constexpr double kGap = 0.07;  // m, between objects: what touches is a matter of segmentation
constexpr std::uint64_t kScansPerState = 3;

/// One of the shapes that stand on tables.
struct Thing {
  std::string kind;
  Shape shape;
  double radius = 0.0;  ///< m, of the circle around its base
};

/// A place on the table: metres from its middle, radians.
struct Place {
  Eigen::Vector2d at;
  double yaw = 0.0;
};

class ScriptMaker {
 public:
  ScriptMaker(ScriptKind kind, std::uint64_t seed, int width)
      : random_(seed * 131 + static_cast<unsigned>(kind)) {
    script_.name = toString(kind) + "_" + std::to_string(seed);
    script_.scans_per_state = kScansPerState;
    Simulation& s = script_.simulation;
    s.seed = seed;
    const double focal = 540.0 * width / 640.0;
    s.sensor.camera = {width, width * 3 / 4, focal, focal, 0.5 * (width - 1), 0.5 * (width * 3 / 4 - 1)};
    s.sensor.edge_mixed = 0.02;
    addFixedSolid(script_.simulation.scene, "floor", BoxShape{{6.0, 6.0, 0.1}}, Pose(0, 0, -0.1, 0, 0, 0),
                  SolidLabel::background);
    addFixedSolid(script_.simulation.scene, "wall", BoxShape{{0.1, 6.0, 2.5}}, Pose(-1.6, 0, 0, 0, 0, 0),
                  SolidLabel::background);
    TableShape table;
    table.size = kTableSize;
    table.height = kTableHeight;
    table_ = addFixedSolid(script_.simulation.scene, "table", table, Pose(), SolidLabel::table);
  }

  ChangeScript make(ScriptKind kind) && {
    switch (kind) {
      case ScriptKind::add:
        add();
        break;
      case ScriptKind::remove:
        remove();
        break;
      case ScriptKind::move:
        move(1);
        break;
      case ScriptKind::nudge:
        nudge();
        break;
      case ScriptKind::pair:
        move(2);
        break;
      case ScriptKind::swap:
        swap();
        break;
      case ScriptKind::behind:
        behind();
        break;
      case ScriptKind::away_and_back:
        awayAndBack();
        break;
      case ScriptKind::table:
        moveTable();
        break;
      case ScriptKind::replace:
        replace();
        break;
    }
    finish();
    return std::move(script_);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Thing randomThing() {
    switch (std::uniform_int_distribution<int>(0, 3)(random_)) {
      case 0:
      case 1: {
        const Eigen::Vector3d size(uniform(0.06, 0.11), uniform(0.12, 0.17), uniform(0.06, 0.18));
        return {"box", BoxShape{size}, 0.5 * size.head<2>().norm()};
      }
      case 2: {
        const double radius = uniform(0.03, 0.05);
        return {"tin", CylinderShape{radius, uniform(0.09, 0.2)}, radius};
      }
      default: {
        TurnedShape mug;
        const double radius = uniform(0.035, 0.045);
        const double height = uniform(0.08, 0.11);
        mug.profile = {{0.9 * radius, 0.0}, {radius, height}};
        mug.wall = 0.004;
        mug.handle = Handle{0.02, height - 0.02, 0.03, 0.006};
        return {"mug", mug, radius + 0.04};
      }
    }
  }

  [[nodiscard]] bool isFree(const Eigen::Vector2d& at, double radius) const {
    for (const auto& [other, other_radius] : taken_) {
      if ((at - other).norm() < radius + other_radius + kGap) return false;
    }
    return true;
  }

  Place freePlace(double radius) {
    const Eigen::Vector2d half = 0.5 * kTableSize - Eigen::Vector2d::Constant(radius + 0.06);
    for (int tries = 0; tries < 100'000; ++tries) {
      const Eigen::Vector2d at(uniform(-half.x(), half.x()), uniform(-half.y(), half.y()));
      if (!isFree(at, radius)) continue;
      taken_.emplace_back(at, radius);
      return {at, uniform(-std::numbers::pi, std::numbers::pi)};
    }
    throw std::logic_error("the table is full");
  }

  std::string put(const Thing& thing, const Place& place, bool present = true) {
    Solid solid;
    solid.name = thing.kind + std::to_string(++objects_);
    solid.surface = std::make_shared<const TriangleMesh>(tessellate(thing.shape));
    solid.support = table_;
    solid.support_T_solid = Pose(place.at.x(), place.at.y(), 0.0, place.yaw, 0.0, 0.0);
    solid.present = present;
    if (thing.kind != "box") script_.round.push_back(solid.name);
    const std::string name = solid.name;
    script_.simulation.scene.add(std::move(solid));
    return name;
  }

  std::string putSomewhere(const Thing& thing, bool present = true) {
    return put(thing, freePlace(thing.radius), present);
  }

  /// Objects that have no part in the change.
  void putBystanders(int count) {
    for (int i = 0; i < count; ++i) putSomewhere(randomThing());
  }

  ExpectedChanges& newState() { return script_.states.emplace_back(); }

  void event(SceneAction action, const std::string& solid, const std::optional<Place>& place = {}) {
    SceneEvent event;
    event.scan = kScansPerState * script_.states.size();
    event.action = action;
    event.solid = solid;
    if (place) {
      event.position = Eigen::Vector3d(place->at.x(), place->at.y(), 0.0);
      event.yaw_pitch_roll = Eigen::Vector3d(place->yaw, 0.0, 0.0);
    }
    events_.push_back(event);
  }

  void add() {
    putBystanders(4);
    const std::string object = putSomewhere(randomThing(), false);
    newState().appeared = {object};
    event(SceneAction::appear, object);
  }

  void remove() {
    putBystanders(3);
    const std::string object = putSomewhere(randomThing());
    newState().vanished = {object};
    event(SceneAction::vanish, object);
  }

  void move(int count) {
    putBystanders(2);
    std::vector<std::pair<std::string, Thing>> movers;
    for (int i = 0; i < count; ++i) {
      const Thing thing = randomThing();
      movers.emplace_back(putSomewhere(thing), thing);
    }
    ExpectedChanges& changes = newState();
    for (const auto& [object, thing] : movers) {
      changes.moved.push_back(object);
      event(SceneAction::move, object, freePlace(thing.radius));
    }
  }

  void nudge() {
    const Thing thing = randomThing();
    Place place = freePlace(thing.radius + 0.05);  // with room around it
    const std::string object = put(thing, place);
    putBystanders(3);
    const double direction = uniform(-std::numbers::pi, std::numbers::pi);
    place.at += uniform(0.03, 0.05) * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    place.yaw += uniform(0.1, 0.4);
    newState().moved = {object};
    event(SceneAction::move, object, place);
  }

  void swap() {
    putBystanders(2);
    const Thing thing = randomThing();
    const std::string first = putSomewhere(thing);
    const std::string second = putSomewhere(thing);
    newState();
    event(SceneAction::swap, first);
    events_.back().other = second;
  }

  void behind() {
    const Thing low{"box", BoxShape{{0.10, 0.18, 0.09}}, 0.12};
    const Thing tall{"box", BoxShape{{0.05, 0.08, 0.24}}, 0.05};
    const Place back{{uniform(-0.2, -0.1), uniform(-0.2, 0.2)}, uniform(-0.2, 0.2)};
    taken_.emplace_back(back.at, low.radius);
    const Place front{back.at + Eigen::Vector2d(0.2, uniform(-0.03, 0.03)), uniform(-0.3, 0.3)};
    taken_.emplace_back(front.at, tall.radius);
    const std::string hidden = put(low, back);
    const std::string occluder = put(tall, front, false);
    putBystanders(1);
    newState().appeared = {occluder};
    event(SceneAction::appear, occluder);
    newState().vanished = {hidden};
    event(SceneAction::vanish, hidden);
  }

  void awayAndBack() {
    putBystanders(3);
    const Thing thing = randomThing();
    const std::string object = putSomewhere(thing);
    newState().vanished = {object};
    event(SceneAction::vanish, object);
    newState().appeared = {object};
    event(SceneAction::appear, object, freePlace(thing.radius));
  }

  void moveTable() {
    putBystanders(4);
    newState().moved = {"table"};
    Place place;
    const double direction = uniform(-std::numbers::pi, std::numbers::pi);
    place.at = uniform(0.08, 0.2) * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    place.yaw = uniform(-0.25, 0.25);
    event(SceneAction::move, "table", place);
  }

  void replace() {
    putBystanders(2);
    const Thing low{"box", BoxShape{{0.14, 0.10, 0.06}}, 0.09};
    const double radius = uniform(0.04, 0.05);
    const Thing tall{"tin", CylinderShape{radius, uniform(0.16, 0.22)}, radius};
    const bool low_first = uniform(0.0, 1.0) < 0.5;
    const Place place = freePlace(0.09);
    const std::string old = put(low_first ? low : tall, place);
    const std::string successor = put(low_first ? tall : low, place, false);
    ExpectedChanges& changes = newState();
    changes.vanished = {old};
    changes.appeared = {successor};
    event(SceneAction::vanish, old);
    event(SceneAction::appear, successor);
  }

  /// One scan a view, the camera going to and fro before the table.
  void finish() {
    Simulation& s = script_.simulation;
    s.script = SceneScript(events_);
    const auto scans = static_cast<int>(kScansPerState * (script_.states.size() + 1));
    for (int k = 0; k < scans; ++k) {
      constexpr double kRadius = 1.15;  // m
      const double angle = 0.25 * std::sin(1.1 * k);
      s.views.push_back(lookAt({kRadius * std::cos(angle), kRadius * std::sin(angle), kTableHeight + 0.65},
                               {0.0, 0.0, kTableHeight}));
    }
  }

  std::mt19937_64 random_;
  ChangeScript script_;
  SolidId table_;
  int objects_ = 0;
  std::vector<std::pair<Eigen::Vector2d, double>> taken_;  ///< circles on the table
  std::vector<SceneEvent> events_;
};

}  // namespace

std::string toString(ScriptKind kind) {
  constexpr std::array<const char*, kScriptKinds> kNames{
      "add", "remove", "move", "nudge", "pair", "swap", "behind", "away_and_back", "table", "replace"};
  return kNames.at(static_cast<std::size_t>(kind));
}

ChangeScript makeChangeScript(ScriptKind kind, std::uint64_t seed, int width) {
  return ScriptMaker(kind, seed, width).make(kind);
}

}  // namespace hoctomap
