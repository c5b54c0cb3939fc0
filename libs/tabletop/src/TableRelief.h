// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <span>
#include <vector>

#include "ObjectCandidates.h"

namespace hoctomap {

/// How a table lies, place by place, to its plane. Tables are bent, lenses distort, and a projector leaves
/// stripes; all of that changes slowly along the surface, while a thing that lies there ends at a step.
class TableRelief {
 public:
  /// @param near  points on and a little above the table
  TableRelief(const TableSurface& table, std::span<const Candidate> near);

  /// Metres above the plane of the table's own surface, at a place of the world.
  [[nodiscard]] double at(double x, double y) const;

 private:
  const SurfaceGrid& grid_;
  std::vector<float> level_;  ///< of every cell
};

}  // namespace hoctomap
