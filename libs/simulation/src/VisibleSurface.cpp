// SPDX-License-Identifier: BSD-3-Clause
#include "hoctomap/simulation/VisibleSurface.h"

#include <cmath>

namespace hoctomap {
namespace {

/// What turns the pixels of one solid into points of its frame.
struct SolidView {
  bool wanted = false;
  Eigen::Isometry3d solid_T_sensor;
};

std::vector<SolidView> viewsOfSolids(const SimulatedScan& scan) {
  const Eigen::Isometry3d world_T_sensor = toIsometry(scan.world_T_sensor);
  std::vector<SolidView> views;
  for (const SolidId id : scan.scene.ids())
    views.push_back({scan.scene.solid(id).label != SolidLabel::background,
                     toIsometry(scan.scene.world_T_solid(id)).inverse() * world_T_sensor});
  return views;
}

}  // namespace

void VisibleSurface::add(const SimulatedScan& scan) {
  const auto views = viewsOfSolids(scan);
  const PinholeCamera& camera = scan.image.camera;
  std::size_t index = 0;
  for (int v = 0; v < camera.height; ++v)
    for (int u = 0; u < camera.width; ++u, ++index) {
      const std::int32_t solid = scan.solids[index];
      if (solid < 0 || !views[static_cast<std::size_t>(solid)].wanted) continue;
      const auto depth = static_cast<double>(scan.rendering.image.depth[index]);
      const Eigen::Vector3d sensor_point = camera.point(u, v, depth);
      addPoint(seen_[SolidId{static_cast<std::uint32_t>(solid)}],
               views[static_cast<std::size_t>(solid)].solid_T_sensor * sensor_point);
    }
}

void VisibleSurface::addPoint(Seen& seen, const Eigen::Vector3d& solid_point) const {
  constexpr std::int64_t kOffset = std::int64_t{1} << 20;  // 21 bits an axis: +-2 km at 2 mm
  const Eigen::Array3d cell = (solid_point / voxel_size_).array().floor();
  std::uint64_t key = 0;
  for (const double c : cell)
    key = (key << 21U) | (static_cast<std::uint64_t>(static_cast<std::int64_t>(c) + kOffset) & 0x1fffffU);
  if (seen.voxels.insert(key).second) seen.sum += ((cell + 0.5) * voxel_size_).matrix();
}

std::size_t VisibleSurface::voxels(SolidId id) const {
  const auto found = seen_.find(id);
  return found == seen_.end() ? 0 : found->second.voxels.size();
}

std::optional<Eigen::Vector3d> VisibleSurface::centroid(SolidId id) const {
  const auto found = seen_.find(id);
  if (found == seen_.end()) return std::nullopt;
  return Eigen::Vector3d(found->second.sum / static_cast<double>(found->second.voxels.size()));
}

}  // namespace hoctomap
