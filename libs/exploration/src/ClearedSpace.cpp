// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/ClearedSpace.h"

#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap {

ClearedSpace::ClearedSpace(const Eigen::AlignedBox3d& world_space, double resolution)
    : space_(world_space), map_(resolution, OccupancyModel{}), update_(makeBlockScanUpdate()) {}

void ClearedSpace::add(const Eigen::Vector3f& world_origin, std::span<const Eigen::Vector3f> world_points) {
  Beams beams;
  beams.origin = world_origin;
  beams.hits = world_points;
  beams.bounds = space_;
  map_.update(*update_, beams);
}

}  // namespace hoctomap
