// SPDX-License-Identifier: BSD-3-Clause
// f'_A of Section IV-C.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "VoxelIndex.h"
#include "hoctomap/tabletop/Tabletop.h"

namespace hoctomap {
namespace {

/// Whether a good part of the segment lies within about `margin` of the node's occupied voxels.
bool liesAtSurface(const MapNode& node, const Obb& node_box, const PointCloud& world_points, double margin) {
  constexpr std::size_t kSample = 400;
  const double cell = margin + node.map().resolution();
  const auto key = [cell](const Eigen::Vector3d& p) -> Eigen::Vector3i {
    return (p / cell).array().floor().matrix().cast<int>();
  };
  VoxelIndex occupied;
  for (const auto& voxel : node.map().occupiedVoxels()) occupied.insert(key(voxel.cast<double>()));
  const Eigen::Isometry3d node_T_world = node_box.world_T_frame.inverse();
  const auto isNear = [&](const Eigen::Vector3d& point) {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz)
          if (occupied.find(key(point) + Eigen::Vector3i(dx, dy, dz)) != VoxelIndex::kNone) return true;
    return false;
  };
  const std::size_t step = std::max<std::size_t>(1, world_points.size() / kSample);
  std::size_t asked = 0;
  std::size_t near = 0;
  for (std::size_t i = 0; i < world_points.size(); i += step) {
    ++asked;
    near += isNear(node_T_world * world_points[i].cast<double>());
  }
  return 4 * near >= asked && near > 0;
}

class BoxAssociation : public AssociationFunction {
 public:
  explicit BoxAssociation(double margin) : margin_(margin) {}

  [[nodiscard]] std::optional<NodeId> associate(const MapHierarchy& hierarchy, const LabelledSegment& segment,
                                                const Admissible& admissible) const override {
    std::optional<NodeId> best;
    std::tuple<std::size_t, double> best_rank;  // depth, overlap
    const Obb grown = segment.box.padded(margin_);
    for (const NodeId id :
         hierarchy.idsNear(worldBounds(grown))) {  // ascending: the first of equals has the lowest id
      if (hierarchy.node(id).label() != segment.label || (admissible && !admissible(id))) continue;
      const Obb box = hierarchy.box(id);
      if (!fallsInto(hierarchy.node(id), box, segment, grown)) continue;
      const std::tuple rank(hierarchy.depth(id), overlapVolume(grown, box));
      if (best && rank <= best_rank) continue;
      best = id;
      best_rank = rank;
    }
    return best;
  }

 private:
  /// The boxes intersect: so says the paper. The margin is for views that drift apart; boxes that meet only
  /// by it need the segment to be at the node's surface, else an object would take in what stands beside it.
  [[nodiscard]] bool fallsInto(const MapNode& node, const Obb& box, const LabelledSegment& segment,
                               const Obb& grown) const {
    if (intersects(segment.box, box)) return true;
    return intersects(grown, box) && segment.world_points != nullptr &&
           liesAtSurface(node, box, *segment.world_points, margin_);
  }

  double margin_;
};

}  // namespace

std::unique_ptr<AssociationFunction> makeTabletopAssociation(double margin) {
  return std::make_unique<BoxAssociation>(margin);
}

}  // namespace hoctomap
