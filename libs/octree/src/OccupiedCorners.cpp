// SPDX-License-Identifier: BSD-3-Clause
#include "OccupiedCorners.h"

#include "TreeAccess.h"

namespace hoctomap::engine {
namespace {

/// The outermost occupied voxel along one axis.
class Outermost {
 public:
  /// @param upwards  towards greater keys
  Outermost(const octomap::OcTree& tree, unsigned axis, bool upwards)
      : tree_(tree), axis_(axis), upwards_(upwards) {
    walk(*tree.getRoot(), kTreeLevels, 0);
  }
  [[nodiscard]] std::optional<octomap::key_type> key() const {
    if (!found_) return std::nullopt;
    return static_cast<octomap::key_type>(*found_);
  }

 private:
  /// @param first  least key of the node's voxels along the axis
  void walk(const Node& node, unsigned level, unsigned first) {
    const unsigned outermost = upwards_ ? first + (1U << level) - 1 : first;
    if (!tree_.isNodeOccupied(node) || (found_ && (upwards_ ? outermost <= *found_ : outermost >= *found_)))
      return;
    bool is_leaf = true;
    if (const auto* const children = NodeAccess::childrenOf(node)) {
      for (const bool far : {true, false}) {
        for (unsigned octant = 0; octant < kOctants; ++octant) {
          const unsigned upper = octant >> axis_ & 1U;
          if (children[octant] == nullptr || (upper == 1U) != (far == upwards_)) continue;
          is_leaf = false;
          walk(static_cast<const Node&>(*children[octant]), level - 1, first + (upper << (level - 1)));
        }
      }
    }
    if (is_leaf) found_ = outermost;
  }

  const octomap::OcTree& tree_;
  unsigned axis_;
  bool upwards_;
  std::optional<unsigned> found_;
};

}  // namespace

std::optional<std::pair<octomap::OcTreeKey, octomap::OcTreeKey>> occupiedCorners(
    const octomap::OcTree& tree) {
  if (tree.getRoot() == nullptr) return std::nullopt;
  std::pair<octomap::OcTreeKey, octomap::OcTreeKey> corners;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto low = Outermost(tree, axis, false).key();
    if (!low) return std::nullopt;
    corners.first[axis] = *low;
    corners.second[axis] = *Outermost(tree, axis, true).key();
  }
  return corners;
}

}  // namespace hoctomap::engine
