// SPDX-License-Identifier: BSD-3-Clause
#include "TableChoice.h"

#include <cmath>
#include <limits>

#include "hoctomap/octree/NodeMap.h"

namespace hoctomap {
namespace {

constexpr double kSink =
    0.05;  // m that an object's underside may lie below a table's surface: drift and noise
constexpr double kAlike = 0.02;  // m, differences of height below this do not decide

/// How an object lies to a table.
struct Support {
  bool over = false;                                        ///< its centre is over the outline
  double height = std::numeric_limits<double>::infinity();  ///< m, |underside - surface|
  double gap = std::numeric_limits<double>::infinity();     ///< m in the plan, centre to surface
};

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
  // The table under an object is not seen: a hole as large as the object belongs to the outline.
  const double hole = bounds.sizes().head<2>().norm() / 2.0 + 2.0 * table.map->resolution();
  const double above = bounds.min().z() - surface;
  support.over = support.gap <= hole && above > -kSink;
  support.height = std::abs(above);
  return support;
}

}  // namespace

int preferredTable(const NodeView& a, const NodeView& b, const NodeView& below) {
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

}  // namespace hoctomap
