// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>

#include "hoctomap/exploration/TableArea.h"

namespace hoctomap {

/// What all beams say of the space over a table, whatever node they belong to. The nodes' own maps are
/// cleared by their own beams only (`carve = own`): the corners of their boxes would stay unknown for ever.
/// The nodes' maps stay untouched.
class ClearedSpace {
 public:
  /// @param resolution m.
  ClearedSpace(const Eigen::AlignedBox3d& world_space, double resolution);

  void add(const Eigen::Vector3f& world_origin, std::span<const Eigen::Vector3f> world_points);

  [[nodiscard]] const Eigen::AlignedBox3d& space() const { return space_; }
  /// In the world frame.
  [[nodiscard]] const NodeMap& map() const { return map_; }

 private:
  Eigen::AlignedBox3d space_;
  NodeMap map_;
  std::unique_ptr<ScanUpdate> update_;
};

}  // namespace hoctomap
