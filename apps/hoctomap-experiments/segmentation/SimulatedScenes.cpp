// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/SimulatedScenes.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "hoctomap/simulation/Shape.h"
#include "hoctomap/simulation/ViewPath.h"
#include "hoctomap/tabletop/LabelImage.h"
#include "measuring/FixedSolid.h"

namespace hoctomap {

namespace {

constexpr double kTable = 0.72;  // m, height
constexpr double kCell = 0.004;  // m, of the height field that things are dropped on
constexpr double kSteady =
    0.003;                       // m that the height under a thing's middle may be below its highest support
constexpr double kWarp = 0.002;  // m, amplitude of each of the waves of a warped table
constexpr double kLeastWave = 0.6;  // m
constexpr int kMostTries = 200;
const Eigen::Vector2d kTableSize(0.9, 1.3);

/// A shape and the part of the table that it covers.
struct Thing {
  std::string kind;
  Shape shape;
  double half_x = 0.0;
  double half_y = 0.0;
  double height = 0.0;
  bool round = false;
};

class SceneMaker {
 public:
  SceneMaker(SceneKind kind, std::uint64_t seed) : kind_(kind), random_(seed * 1009 + 17) {
    simulation_.seed = seed;
    simulation_.sensor.edge_mixed = 0.02;
    addFixedSolid(simulation_.scene, "floor", BoxShape{{8.0, 8.0, 0.1}}, Pose(0, 0, -0.1, 0, 0, 0),
                  SolidLabel::background);
    columns_ = static_cast<int>(kTableSize.x() / kCell);
    rows_ = static_cast<int>(kTableSize.y() / kCell);
    heights_.assign(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_), 0.0F);
  }

  Simulation make() && {
    addTable();
    switch (kind_) {
      case SceneKind::piled:
        pile();
        break;
      case SceneKind::thin:
        layOut();
        break;
      case SceneKind::far:
        standApart();
        break;
      case SceneKind::bare:
        break;
    }
    addView();
    return std::move(simulation_);
  }

 private:
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }
  int between(int low, int high) { return std::uniform_int_distribution<int>(low, high)(random_); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

  void addTable() {
    const bool warped = kind_ == SceneKind::thin || kind_ == SceneKind::bare;
    if (!warped) {
      TableShape table;
      table.size = kTableSize;
      table.height = kTable;
      addFixedSolid(simulation_.scene, "table", table, Pose(), SolidLabel::table);
      return;
    }
    struct Wave {
      Eigen::Vector2d k;
      double phase;
    };
    std::vector<Wave> waves;
    for (int i = 0; i < 3; ++i) {
      const double length = uniform(kLeastWave, 2.0);
      const double angle = uniform(0.0, 2.0 * std::numbers::pi);
      waves.push_back({Eigen::Vector2d(std::cos(angle), std::sin(angle)) * 2.0 * std::numbers::pi / length,
                       uniform(0.0, 2.0 * std::numbers::pi)});
    }
    warp_ = [waves](const Eigen::Vector2d& p) {
      double sum = 0.0;
      for (const auto& wave : waves) sum += kWarp * std::sin(wave.k.dot(p) + wave.phase);
      return sum;
    };
    TriangleMesh mesh;
    constexpr double kStep = 0.02;
    const int nx = static_cast<int>(kTableSize.x() / kStep);
    const int ny = static_cast<int>(kTableSize.y() / kStep);
    for (int y = 0; y <= ny; ++y) {
      for (int x = 0; x <= nx; ++x) {
        const Eigen::Vector2d p(x * kStep - kTableSize.x() / 2.0, y * kStep - kTableSize.y() / 2.0);
        mesh.vertices.emplace_back(p.x(), p.y(), kTable + warp_(p));
      }
    }
    for (int y = 0; y < ny; ++y) {
      for (int x = 0; x < nx; ++x) {
        const auto at = [&](int i, int j) { return static_cast<std::uint32_t>((y + j) * (nx + 1) + x + i); };
        mesh.triangles.push_back({at(0, 0), at(1, 0), at(1, 1)});
        mesh.triangles.push_back({at(0, 0), at(1, 1), at(0, 1)});
      }
    }
    Solid solid;
    solid.name = "table";
    solid.label = SolidLabel::table;
    solid.surface = std::make_shared<const TriangleMesh>(std::move(mesh));
    simulation_.scene.add(std::move(solid));
  }

  void addView() {
    const bool far = kind_ == SceneKind::far;
    const double distance = far ? uniform(1.5, 3.0) : uniform(0.75, 1.1);
    const double elevation = far ? uniform(0.35, 0.6) : uniform(0.55, 0.95);
    const double angle = uniform(-0.9, 0.9);
    const Eigen::Vector3d target(0.0, 0.0, kTable);
    const Eigen::Vector3d eye =
        target + distance * Eigen::Vector3d(std::cos(elevation) * std::cos(angle),
                                            std::cos(elevation) * std::sin(angle), std::sin(elevation));
    simulation_.views = {lookAt(eye, target)};
  }

  Thing box(const Eigen::Vector3d& size) {
    return {"box", BoxShape{size}, size.x() / 2.0, size.y() / 2.0, size.z(), false};
  }
  Thing tin() {
    const double radius = uniform(0.03, 0.05);
    const double height = uniform(0.06, 0.16);
    return {"tin", CylinderShape{radius, height}, radius, radius, height, true};
  }
  Thing bottle() {
    const double radius = uniform(0.03, 0.04);
    const double height = uniform(0.16, 0.22);
    TurnedShape shape;
    shape.profile = {{radius, 0.0},
                     {radius, 0.6 * height},
                     {0.75 * radius, 0.72 * height},
                     {0.45 * radius, 0.85 * height},
                     {0.45 * radius, height}};
    return {"bottle", shape, radius, radius, height, true};
  }
  Thing mug() {
    const double radius = uniform(0.035, 0.045);
    const double height = uniform(0.08, 0.11);
    TurnedShape shape;
    shape.profile = {{0.9 * radius, 0.0}, {radius, height}};
    shape.wall = 0.004;
    shape.handle = Handle{0.02, height - 0.02, 0.03, 0.006};
    return {"mug", shape, radius + 0.035, radius, height, false};
  }
  Thing bowl() {
    const double radius = uniform(0.055, 0.08);
    const double height = uniform(0.045, 0.07);
    TurnedShape shape;
    for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
      shape.profile.emplace_back(radius * (0.45 + 0.55 * std::sqrt(t)), height * t);
    shape.wall = 0.004;
    return {"bowl", shape, radius, radius, height, true};
  }
  Thing plate() {
    const double radius = uniform(0.08, 0.13);
    TurnedShape shape;
    shape.profile = {{0.6 * radius, 0.0}, {0.7 * radius, 0.004}, {radius, uniform(0.011, 0.016)}};
    shape.wall = 0.004;
    return {"plate", shape, radius, radius, 0.013, true};
  }

  Thing solidThing() {
    const double kind = uniform(0.0, 1.0);
    if (kind < 0.5) return box({uniform(0.05, 0.16), uniform(0.05, 0.2), uniform(0.03, 0.18)});
    if (kind < 0.7) return tin();
    if (kind < 0.8) return bottle();
    return kind < 0.9 ? mug() : bowl();
  }
  Thing thinThing() {
    switch (between(0, 5)) {
      case 0:
        return plate();
      case 1:  // a book
        return box({uniform(0.12, 0.16), uniform(0.18, 0.24), uniform(0.009, 0.013)});
      case 2:  // a phone
        return box({uniform(0.06, 0.075), uniform(0.12, 0.15), uniform(0.007, 0.009)});
      case 3:  // a pen
        return box({uniform(0.009, 0.013), uniform(0.13, 0.16), uniform(0.008, 0.013)});
      case 4:  // cutlery
        return box({uniform(0.018, 0.025), uniform(0.17, 0.21), uniform(0.003, 0.005)});
      default:  // a case
        return box({uniform(0.12, 0.14), uniform(0.12, 0.15), uniform(0.003, 0.008)});
    }
  }

  /// Calls `visit(height)` for every cell under a thing, where the table goes on; false if it does not.
  template <typename Visit>
  bool under(const Thing& thing, double x, double y, double yaw, double margin, const Visit& visit) {
    const double reach = std::hypot(thing.half_x, thing.half_y) + margin;
    const double c = std::cos(yaw);
    const double s = std::sin(yaw);
    for (double v = y - reach; v <= y + reach; v += kCell) {
      for (double u = x - reach; u <= x + reach; u += kCell) {
        const double a = c * (u - x) + s * (v - y);
        const double b = -s * (u - x) + c * (v - y);
        const bool in = thing.round
                            ? std::hypot(a, b) <= thing.half_x + margin
                            : std::abs(a) <= thing.half_x + margin && std::abs(b) <= thing.half_y + margin;
        if (!in) continue;
        const int column = static_cast<int>(std::floor((u + kTableSize.x() / 2.0) / kCell));
        const int row = static_cast<int>(std::floor((v + kTableSize.y() / 2.0) / kCell));
        if (column < 0 || row < 0 || column >= columns_ || row >= rows_) return false;
        visit(heights_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                       static_cast<std::size_t>(column)]);
      }
    }
    return true;
  }

  /// Puts a thing down at rest where it lands; false if it would fall.
  bool drop(const Thing& thing, double x, double y, double yaw, double gap, bool on_table_only) {
    float highest = 0.0F;
    if (!under(thing, x, y, yaw, gap, [&](float h) { highest = std::max(highest, h); })) return false;
    if (on_table_only && highest > 0.0F) return false;
    double at_middle = 0.0;
    Thing middle = thing;
    middle.half_x = middle.half_y = kCell;
    under(middle, x, y, yaw, 0.0, [&](float h) { at_middle = std::max(at_middle, static_cast<double>(h)); });
    if (static_cast<double>(highest) - at_middle > kSteady) return false;
    const auto top = static_cast<float>(static_cast<double>(highest) + thing.height);
    under(thing, x, y, yaw, 0.0, [&](float& h) { h = top; });
    Solid solid;
    solid.name = thing.kind + std::to_string(++objects_);
    solid.surface = std::make_shared<const TriangleMesh>(tessellate(thing.shape));
    solid.top = thing.height;
    const double table = kTable + (warp_ ? warp_({x, y}) : 0.0);
    solid.support_T_solid = Pose(x, y, table + static_cast<double>(highest), yaw, 0.0, 0.0);
    simulation_.scene.add(std::move(solid));
    return true;
  }

  void pile() {
    const int things = between(8, 16);
    const int heaps = between(2, 3);
    std::vector<Eigen::Vector2d> heap;
    for (int i = 0; i < heaps; ++i) heap.emplace_back(uniform(-0.12, 0.12), 0.7 * ((i + 0.5) / heaps - 0.5));
    for (int tries = 0; objects_ < things && tries < kMostTries; ++tries) {
      const auto& at = heap[static_cast<std::size_t>(between(0, heaps - 1))];
      drop(solidThing(), at.x() + uniform(-0.15, 0.15), at.y() + uniform(-0.14, 0.14),
           uniform(0.0, std::numbers::pi), 0.0, false);
    }
  }
  void layOut() {
    const int things = between(5, 9);
    for (int tries = 0; objects_ < things && tries < kMostTries; ++tries) {
      const bool thin = objects_ < things - 2;
      drop(thin ? thinThing() : solidThing(), uniform(-0.3, 0.3), uniform(-0.35, 0.35),
           uniform(0.0, std::numbers::pi), thin ? 0.03 : 0.0, thin);
    }
  }
  void standApart() {
    const int things = between(3, 6);
    for (int tries = 0; objects_ < things && tries < kMostTries; ++tries)
      drop(solidThing(), uniform(-0.3, 0.3), uniform(-0.5, 0.5), uniform(0.0, std::numbers::pi), 0.05, true);
  }

  SceneKind kind_;
  std::mt19937_64 random_;
  Simulation simulation_;
  std::function<double(const Eigen::Vector2d&)> warp_;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<float> heights_;  ///< m above the table
  int objects_ = 0;
};

}  // namespace

std::string toString(SceneKind kind) {
  switch (kind) {
    case SceneKind::piled:
      return "piled";
    case SceneKind::thin:
      return "thin";
    case SceneKind::far:
      return "far";
    case SceneKind::bare:
      break;
  }
  return "bare";
}

Simulation makeSegmentationScene(SceneKind kind, std::uint64_t seed) {
  return SceneMaker(kind, seed).make();
}

SimulatedView look(const Simulation& scene) {
  SimulatedView view;
  simulateScene(scene, 0, [&](const SimulatedScan& scan) {
    view.z = unproject(scan.image, scan.world_T_sensor, {});
    view.z.stamp = scan.stamp;
    view.z.sensor = scan.sensor;
    view.truth = {scan.image.camera.width, scan.image.camera.height, scan.labels};
    for (auto& value : view.truth.values) {
      if (value == label_value::no_return) continue;
      value = value < label_value::first_object
                  ? std::uint16_t{1}
                  : static_cast<std::uint16_t>(20 + 10 * (value - label_value::first_object));
    }
  });
  return view;
}

}  // namespace hoctomap
