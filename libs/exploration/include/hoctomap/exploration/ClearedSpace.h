// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "hoctomap/existence/BeamExistenceModel.h"
#include "hoctomap/exploration/TableArea.h"

namespace hoctomap {

/// What all beams say of the space over a table, whatever node they belong to. The nodes' own maps are
/// cleared by their own beams only (`carve = own`): the corners of their boxes would stay unknown for ever.
/// The nodes' maps stay untouched.
///
/// What is measured worse than it is kept (sigma above the resolution) clears the way up to three sigma
/// before its end and marks nothing: a surface that was seen from afar is still to be looked at.
class ClearedSpace {
 public:
  /// @param resolution m. @param noise of the ranges.
  ClearedSpace(const Eigen::AlignedBox3d& world_space, double resolution, const RangeNoise& noise = {});

  void add(const Eigen::Vector3f& world_origin, std::span<const Eigen::Vector3f> world_points);

  [[nodiscard]] const Eigen::AlignedBox3d& space() const { return space_; }
  /// In the world frame.
  [[nodiscard]] const NodeMap& map() const { return map_; }

 private:
  Eigen::AlignedBox3d space_;
  RangeNoise noise_;
  NodeMap map_;
  std::unique_ptr<ScanUpdate> update_;
};

}  // namespace hoctomap
