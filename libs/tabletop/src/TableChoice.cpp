// SPDX-License-Identifier: BSD-3-Clause
#include "TableChoice.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "hoctomap/octree/NodeMap.h"

namespace hoctomap {
namespace {

constexpr double kSink =
    0.05;  // m that an object's underside may lie below a table's surface: drift and noise
constexpr double kAlike = 0.02;  // m, differences of height below this do not decide
constexpr double kBroad = 0.1;   // m, of the rim of a hole, whatever the table's resolution
constexpr double kHair = 1e-6;   // m, rounding

/// How an object lies to a table.
struct Support {
  bool over = false;                                        ///< its centre is over the outline
  double height = std::numeric_limits<double>::infinity();  ///< m, |underside - surface|
  double gap = std::numeric_limits<double>::infinity();     ///< m in the plan, centre to surface
};

/// The table under an object is not seen: a hole as large as the object, and a rim of two voxels, belongs to
/// the outline. Metres.
double holeUnder(const NodeView& object, double rim) {
  return worldBounds(object.box).sizes().head<2>().norm() / 2.0 + std::min(rim, kBroad);
}

double holeUnder(const NodeView& object, const NodeMap& table) {
  return holeUnder(object, 2.0 * table.resolution());
}

Support supportOf(const NodeView& table, const NodeView& object) {
  Support support;
  if (table.map == nullptr || object.box.box.isEmpty()) return support;
  const Eigen::AlignedBox3d bounds = worldBounds(object.box);
  const Eigen::Vector3d center = object.box.center();
  double surface = 0.0;
  for (const auto& voxel : table.map->occupiedVoxels()) {
    const Eigen::Vector3d at = table.box.world_T_frame * voxel.cast<double>();
    const double gap = (at - center).head<2>().norm();
    if (gap >= support.gap) continue;
    support.gap = gap;
    surface = at.z();
  }
  if (!std::isfinite(support.gap)) return support;
  const double above = bounds.min().z() - surface;
  support.over = support.gap <= holeUnder(object, *table.map) && above > -kSink;
  support.height = std::abs(above);
  return support;
}

/// Distances in the plan, from the object's centre to the nearest and to the farthest point of a table's box.
struct PlanDistances {
  PlanDistances(const Obb& table, const Eigen::Vector2d& center) {
    const Eigen::AlignedBox3d bounds = worldBounds(table);
    const Eigen::AlignedBox2d plan(bounds.min().head<2>(), bounds.max().head<2>());
    nearest = plan.exteriorDistance(center);
    farthest = (center - plan.center()).cwiseAbs().norm() + plan.sizes().norm() / 2.0;
  }
  double nearest;
  double farthest;
};

/// Whether `far` lies so far from the object that `near` is preferred whatever their voxels are: with many
/// tables, most are.
bool isOutOfQuestion(const NodeView& far, const NodeView& near, const NodeView& object) {
  if (far.map == nullptr || near.map == nullptr || far.box.box.isEmpty() || near.box.box.isEmpty() ||
      object.box.box.isEmpty()) {
    return false;
  }
  const Eigen::Vector2d center = object.box.center().head<2>();
  const double nearest = PlanDistances(far.box, center).nearest - kHair;
  return nearest > holeUnder(object, *far.map) && nearest > PlanDistances(near.box, center).farthest;
}

}  // namespace

int preferredTable(const NodeView& a, const NodeView& b, const NodeView& below) {
  if (isOutOfQuestion(a, b, below)) return 1;
  if (isOutOfQuestion(b, a, below)) return -1;
  const Support on_a = supportOf(a, below);
  const Support on_b = supportOf(b, below);
  if (on_a.over != on_b.over) return on_a.over ? -1 : 1;
  if (std::isinf(on_a.gap) || std::isinf(on_b.gap)) {
    return std::isinf(on_a.gap) == std::isinf(on_b.gap) ? 0 : (std::isinf(on_b.gap) ? -1 : 1);
  }
  if (on_a.over && std::abs(on_a.height - on_b.height) > kAlike) return on_a.height < on_b.height ? -1 : 1;
  if (on_a.gap != on_b.gap) return on_a.gap < on_b.gap ? -1 : 1;
  return 0;
}

Eigen::AlignedBox3d reachOfChoice(const NodeView& table, const NodeView& below) {
  const Eigen::Vector2d center = below.box.center().head<2>();
  const double radius =
      std::max(holeUnder(below, kBroad), PlanDistances(table.box, center).farthest) + 2.0 * kHair;
  const double all = std::numeric_limits<double>::infinity();
  return {Eigen::Vector3d(center.x() - radius, center.y() - radius, -all),
          Eigen::Vector3d(center.x() + radius, center.y() + radius, all)};
}

}  // namespace hoctomap
