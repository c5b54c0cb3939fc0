// SPDX-License-Identifier: BSD-3-Clause
#include "Strays.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "ScanBlocks.h"
#include "VoxelIndex.h"

namespace hoctomap {
namespace {

/// All objects' points in voxels of the radius within which they are searched.
class ObjectPoints {
 public:
  ObjectPoints(const PointCloud& world_points, const std::vector<PointIndices>& objects, double radius)
      : world_points_(world_points), radius_(radius) {
    std::size_t count = 0;
    for (const auto& object : objects) count += object.size();
    points_.reserve(count);
    for (std::size_t k = 0; k < objects.size(); ++k) {
      for (const auto i : objects[k]) add(i, k);
    }
  }

  /// The object with the nearest point within the radius; of equally near points the first counts.
  [[nodiscard]] std::optional<std::size_t> nearest(const Eigen::Vector3f& p) {
    lookAround(floorOf(p.cast<double>() / radius_));
    const auto radius = static_cast<float>(radius_);
    float best = radius * radius;
    std::optional<std::size_t> object;
    for (const auto voxel : around_) {
      for (auto at = last_in_voxel_[voxel]; at != VoxelIndex::kNone; at = points_[at].previous) {
        const Eigen::Vector3f d = world_points_[points_[at].point] - p;
        const float distance = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
        if (distance > best) continue;
        object = object && distance == best ? std::min(*object, points_[at].object) : points_[at].object;
        best = distance;
      }
    }
    return object;
  }

 private:
  struct ObjectPoint {
    std::uint32_t point;
    std::uint32_t previous;  ///< of the same voxel
    std::size_t object;
  };

  /// Finds the voxels that may hold what is near; points come in rows, so that mostly they are the last ones.
  void lookAround(const Eigen::Vector3i& key) {
    if (looked_around_ && key == key_) return;
    looked_around_ = true;
    key_ = key;
    around_.clear();
    for (int n = 0; n < 27; ++n) {
      const auto voxel = voxels_.find(key + Eigen::Vector3i(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1));
      if (voxel != VoxelIndex::kNone) around_.push_back(voxel);
    }
  }

  void add(std::uint32_t point, std::size_t object) {
    const auto voxel = voxels_.insert(floorOf(world_points_[point].cast<double>() / radius_));
    if (voxel == last_in_voxel_.size()) last_in_voxel_.push_back(VoxelIndex::kNone);
    points_.push_back({point, last_in_voxel_[voxel], object});
    last_in_voxel_[voxel] = static_cast<std::uint32_t>(points_.size() - 1);
  }

  const PointCloud& world_points_;
  double radius_;
  VoxelIndex voxels_;
  std::vector<std::uint32_t> last_in_voxel_;
  std::vector<ObjectPoint> points_;

  bool looked_around_ = false;
  Eigen::Vector3i key_ = Eigen::Vector3i::Zero();
  std::vector<std::uint32_t> around_;  ///< voxels that hold something, of those around `key_`
};

/// Sorts indices of which all but the first `sorted` have been added in ascending order.
void mergeAdded(PointIndices& indices, std::size_t sorted) {
  std::inplace_merge(indices.begin(), indices.begin() + static_cast<std::ptrdiff_t>(sorted), indices.end());
}

}  // namespace

void attachStrays(const Measurement& z, std::vector<TableSurface>& tables, std::vector<PointIndices>& objects,
                  const TabletopSegmentationConfig& config) {
  std::vector<bool> taken(z.world_points.size(), false);
  std::vector<std::size_t> table_sizes;
  std::vector<std::size_t> object_sizes;
  for (const auto& table : tables) {
    for (const auto i : table.points) taken[i] = true;
    table_sizes.push_back(table.points.size());
  }
  for (const auto& object : objects) {
    for (const auto i : object) taken[i] = true;
    object_sizes.push_back(object.size());
  }
  ObjectPoints object_points(z.world_points, objects, config.cluster_tolerance);

  const Eigen::Vector3d origin = z.origin();
  const auto isOverTable = [&](const Eigen::AlignedBox3d& box) {
    return std::any_of(tables.begin(), tables.end(), [&](const TableSurface& table) {
      return table.grid.bounds().intersects(inPlan(box)) &&
             Heights(table.plane, box).low <= config.object_height_max;
    });
  };
  struct Flat {
    std::uint32_t point;
    std::size_t table;
    std::size_t cell;
  };
  std::vector<Flat> flat_points;
  // By table and cell; > 0 where it is no wall's, whose points are as dense above the flat band as in it.
  std::map<std::pair<std::size_t, std::size_t>, int> flatness;
  ScanBlocks(z).visit(isOverTable, [&](std::uint32_t i) {
    if (taken[i]) return;
    const Eigen::Vector3d p = z.world_points[i].cast<double>();
    for (std::size_t t = 0; t < tables.size(); ++t) {
      const TableSurface& table = tables[t];
      const double height = table.plane.signedDistance(p);
      if (height > config.object_height_max) continue;
      const auto cell = table.grid.cellOf(p.x(), p.y());
      if (cell >= table.grid.size() || !table.extent[cell]) continue;
      const double flat = config.certainHeight((p - origin).norm());
      if (height < -flat) continue;
      if (std::abs(height) <= flat) {
        flat_points.push_back({i, t, cell});
        ++flatness[{t, cell}];
      } else if (const auto object = object_points.nearest(z.world_points[i])) {
        objects[*object].push_back(i);
      } else {
        if (height <= 3 * flat) flatness[{t, cell}] -= 2;  // a band as thick, above: half as many are enough
        continue;
      }
      break;
    }
  });
  for (const Flat& flat : flat_points) {  // what goes on upwards is a wall at the table's edge
    if (flatness.at({flat.table, flat.cell}) > 0) tables[flat.table].points.push_back(flat.point);
  }
  for (std::size_t k = 0; k < objects.size(); ++k) mergeAdded(objects[k], object_sizes[k]);
  for (std::size_t k = 0; k < tables.size(); ++k) mergeAdded(tables[k].points, table_sizes[k]);
}

}  // namespace hoctomap
