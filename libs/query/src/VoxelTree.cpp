// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelTree.h"

#include <nanoflann.hpp>

namespace hoctomap {

struct VoxelTree::Index {
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Index>, Index, 3>;

  explicit Index(const PointCloud& all)
      : points(all), tree(3, *this, nanoflann::KDTreeSingleIndexAdaptorParams(16)) {
    tree.buildIndex();
  }

  // nanoflann's names
  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    return points[i][static_cast<Eigen::Index>(axis)];
  }
  template <typename Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }

  PointCloud points;
  Tree tree;
};

VoxelTree::VoxelTree(const PointCloud& points) : index_(std::make_unique<Index>(points)) {}
VoxelTree::~VoxelTree() = default;
VoxelTree::VoxelTree(VoxelTree&&) noexcept = default;
VoxelTree& VoxelTree::operator=(VoxelTree&&) noexcept = default;

bool VoxelTree::hasNear(const Eigen::Vector3f& p, double radius) const {
  if (index_->points.empty()) return false;
  std::size_t nearest = 0;
  float squared = 0.0F;
  nanoflann::KNNResultSet<float> result(1);
  result.init(&nearest, &squared);
  index_->tree.findNeighbors(result, p.data(), nanoflann::SearchParams());
  return static_cast<double>(squared) <= radius * radius;
}

}  // namespace hoctomap
