// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/exploration/ClearedSpace.h"

#include "hoctomap/octree/BlockScanUpdate.h"

namespace hoctomap {

ClearedSpace::ClearedSpace(const Eigen::AlignedBox3d& world_space, double resolution, const RangeNoise& noise)
    : space_(world_space),
      noise_(noise),
      map_(resolution, OccupancyModel{}),
      update_(makeBlockScanUpdate()) {}

void ClearedSpace::add(const Eigen::Vector3f& world_origin, std::span<const Eigen::Vector3f> world_points) {
  PointCloud hits;
  PointCloud passing;
  for (const Eigen::Vector3f& point : world_points) {
    const Eigen::Vector3f beam = point - world_origin;
    const auto range = static_cast<double>(beam.norm());
    const double sigma = noise_.sigma(range);
    if (sigma <= map_.resolution()) {
      hits.push_back(point);
    } else if (3.0 * sigma < range) {
      passing.emplace_back(world_origin + static_cast<float>(1.0 - 3.0 * sigma / range) * beam);
    }
  }
  Beams beams;
  beams.origin = world_origin;
  beams.hits = hits;
  beams.passing = passing;
  beams.bounds = space_;
  map_.update(*update_, beams);
}

}  // namespace hoctomap
