// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "hoctomap/hierarchy/Relation.h"

namespace hoctomap {

/// Which of two tables an object stands on: negative for `a`, positive for `b`, 0 if both would do. The table
/// over whose outline the object's centre lies; then the one whose surface there is nearest to its underside;
/// then the one with surface nearer in the plan.
[[nodiscard]] int preferredTable(const NodeView& a, const NodeView& b, const NodeView& below);

/// Where the box of a table must reach that is preferred to another one: see `RelationSet::Reach`.
[[nodiscard]] Eigen::AlignedBox3d reachOfChoice(const NodeView& table, const NodeView& below);

}  // namespace hoctomap
