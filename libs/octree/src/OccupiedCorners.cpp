// SPDX-License-Identifier: BSD-3-Clause
#include "OccupiedCorners.h"

#include <algorithm>

#include "TreeAccess.h"

namespace hoctomap::engine {
namespace {

/// Looks for a voxel that is farther out along one axis. Enters only what may hold one, outer branches first.
class Outermost {
 public:
  /// @param upwards  towards greater keys
  Outermost(const octomap::OcTree& tree, unsigned axis, bool upwards)
      : tree_(tree), axis_(axis), upwards_(upwards) {}

  /// What is farther in does not count.
  void startFrom(const octomap::OcTreeKey& occupied) { found_ = occupied; }

  std::optional<octomap::OcTreeKey> searchIn(const KeyBox& box) {
    if (!box.empty() && tree_.getRoot() != nullptr) {
      box_ = box;
      walk(*tree_.getRoot(), kTreeLevels, octomap::OcTreeKey(0, 0, 0));
    }
    return found_;
  }

 private:
  /// @param first  the least keys of the node's voxels
  void walk(const Node& node, unsigned level, const octomap::OcTreeKey& first) {
    const unsigned last = (1U << level) - 1;
    const unsigned outermost = upwards_ ? first[axis_] + last : first[axis_];
    if (!tree_.isNodeOccupied(node) ||
        (found_ && (upwards_ ? outermost <= (*found_)[axis_] : outermost >= (*found_)[axis_])))
      return;
    for (unsigned i = 0; i < 3; ++i) {
      if (static_cast<int>(first[i] + last) < box_.min[i] || static_cast<int>(first[i]) > box_.max[i]) return;
    }
    bool is_leaf = true;
    if (const auto* const children = NodeAccess::childrenOf(node)) {
      for (const bool far : {true, false}) {
        for (unsigned octant = 0; octant < kOctants; ++octant) {
          const unsigned upper = octant >> axis_ & 1U;
          if (children[octant] == nullptr || (upper == 1U) != (far == upwards_)) continue;
          is_leaf = false;
          walk(static_cast<const Node&>(*children[octant]), level - 1, childKey(first, level, octant));
        }
      }
    }
    if (!is_leaf) return;
    found_ = first;
    (*found_)[axis_] = static_cast<octomap::key_type>(outermost);
  }

  const octomap::OcTree& tree_;
  unsigned axis_;
  bool upwards_;
  KeyBox box_;
  std::optional<octomap::OcTreeKey> found_;
};

bool isOccupied(const octomap::OcTree& tree, const octomap::OcTreeKey& voxel) {
  const Node* const node = tree.search(voxel);
  return node != nullptr && tree.isNodeOccupied(node);
}

}  // namespace

void OccupiedCorners::changed(const KeyBox& occupied) {
  valid_ = false;
  if (occupied.empty()) return;
  changed_ = changed_.empty() ? occupied : changed_.merged(occupied);
}

const std::optional<OccupiedCorners::Corners>& OccupiedCorners::of(const octomap::OcTree& tree) {
  if (valid_) return corners_;
  const bool had_any = corners_.has_value();
  corners_.emplace();
  for (unsigned side = 0; side < outermost_.size() && corners_; ++side) {
    const unsigned axis = side / 2;
    Outermost search(tree, axis, side % 2 == 1);
    const bool stands = had_any && isOccupied(tree, outermost_[side]);
    if (stands) search.startFrom(outermost_[side]);
    if (const auto voxel = search.searchIn(stands ? changed_ : kAllKeys)) {
      outermost_[side] = *voxel;
      (side % 2 == 1 ? corners_->second : corners_->first)[axis] = (*voxel)[axis];
    } else {
      corners_.reset();
    }
  }
  changed_ = kNoKeys;
  valid_ = true;
  return corners_;
}

}  // namespace hoctomap::engine
