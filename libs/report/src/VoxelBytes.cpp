// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelBytes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hoctomap {

namespace {

constexpr unsigned kDepth = 16;
constexpr unsigned kFreeCells = 96;

enum Child : unsigned { kUnknown = 0, kFree = 1, kOccupied = 2, kInner = 3 };

/// Bounds of the free leaves, in voxels.
struct Bounds {
  std::array<unsigned, 3> low{std::numeric_limits<unsigned>::max(), std::numeric_limits<unsigned>::max(),
                              std::numeric_limits<unsigned>::max()};
  std::array<unsigned, 3> high{};

  void add(const std::array<unsigned, 3>& corner, unsigned size) {
    for (unsigned k = 0; k < 3; ++k) {
      low[k] = std::min(low[k], corner[k]);
      high[k] = std::max(high[k], corner[k] + size);
    }
  }
  [[nodiscard]] unsigned longest() const {
    unsigned side = 0;
    for (unsigned k = 0; k < 3; ++k) side = std::max(side, high[k] > low[k] ? high[k] - low[k] : 0);
    return side;
  }
};

class Writer {
 public:
  explicit Writer(const octomap::OcTree& tree) : tree_(tree) {}

  [[nodiscard]] std::string bytes() {
    const octomap::OcTreeNode* root = tree_.getRoot();
    // A root that is a leaf would be one state for all that can be addressed: no map of measurements.
    if (root != nullptr && tree_.nodeHasChildren(root)) {
      Bounds bounds;
      measure(*root, {}, 1U << kDepth, bounds);
      while (bounds.longest() > kFreeCells * free_cell_) free_cell_ *= 2;
      descend(*root, 1U << kDepth);
    }
    std::string out;
    for (unsigned i = 0; i < 4; ++i) out += static_cast<char>(children_.size() / 2 >> 8U * i & 255U);
    return out + children_ + probabilities_;
  }

 private:
  void measure(const octomap::OcTreeNode& node, const std::array<unsigned, 3>& corner, unsigned size,
               Bounds& bounds) const {
    for (unsigned i = 0; i < 8; ++i) {
      if (!tree_.nodeChildExists(&node, i)) continue;
      const octomap::OcTreeNode& child = *tree_.getNodeChild(&node, i);
      const unsigned half = size / 2;
      const std::array<unsigned, 3> at{corner[0] + (i & 1U) * half, corner[1] + (i >> 1U & 1U) * half,
                                       corner[2] + (i >> 2U) * half};
      if (tree_.nodeHasChildren(&child)) {
        measure(child, at, half, bounds);
      } else if (!tree_.isNodeOccupied(&child)) {
        bounds.add(at, half);
      }
    }
  }

  /// Writes the children of a node of `size` voxels and says what the node is: a leaf, if that is enough.
  Child descend(const octomap::OcTreeNode& node, unsigned size) {
    const std::size_t at = children_.size();
    const std::size_t leaves = probabilities_.size();
    children_.append(2, '\0');
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i) {
      if (!tree_.nodeChildExists(&node, i)) continue;
      const octomap::OcTreeNode& child = *tree_.getNodeChild(&node, i);
      Child kind = tree_.isNodeOccupied(&child) ? kOccupied : kFree;
      if (tree_.nodeHasChildren(&child)) {
        kind = descend(child, size / 2);
      } else if (kind == kOccupied) {
        probabilities_ += static_cast<char>(std::lround(255.0 * child.getOccupancy()));
      } else if (size <= free_cell_) {
        kind = kUnknown;  // beside something occupied, or the whole cell will be free
      }
      bits |= kind << 2U * i;
    }
    if (size <= free_cell_ && probabilities_.size() == leaves) {
      children_.resize(at);
      return size == free_cell_ ? kFree : kUnknown;
    }
    children_[at] = static_cast<char>(bits & 255U);
    children_[at + 1] = static_cast<char>(bits >> 8U);
    return kInner;
  }

  const octomap::OcTree& tree_;
  unsigned free_cell_ = 1;  ///< voxels a side of the finest free space that is kept
  std::string children_;
  std::string probabilities_;
};

}  // namespace

std::string voxelBytes(const NodeMap& map) {
  return Writer(map.tree()).bytes();
}

}  // namespace hoctomap
